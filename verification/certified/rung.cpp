#include "verification/certified/rung.h"

namespace irradiff {

const char* nameOf(Rung rung) {
  switch (rung) {
    case Rung::kDouble:
      return "double";
    case Rung::kExtended:
      return "extended";
    case Rung::kBall:
      return "ball";
  }
  return "";
}

}  // namespace irradiff
