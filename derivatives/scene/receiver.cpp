#include "derivatives/scene/receiver.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"

#include <cmath>
#include <string>

namespace irradiff {

namespace {

template <int Dimension>
void validateReceiver(const ReceiverIn<Dimension>& receiver, std::size_t index) {
  const auto refuse = [index](const std::string& reason) {
    throw InvalidScene("receiver " + std::to_string(index) + ": " + reason);
  };
  if (!receiver.position.allFinite()) {
    refuse("position " + pointText(receiver.position) + " is not finite, must be finite");
  }
  if (!receiver.normal.allFinite()) refuse("normal " + pointText(receiver.normal) + " is not finite, must be finite");
  // A stable norm, because squares of coordinates overflow and underflow long before the coordinates do.
  const double length = receiver.normal.stableNorm();
  if (!(std::abs(length - 1) <= kUnitNormalTolerance)) {
    refuse("normal " + pointText(receiver.normal) + " has length " + numberText(length) + ", must be 1 within " +
           numberText(kUnitNormalTolerance));
  }
}

}  // namespace

void validate(const Receiver& receiver, std::size_t index) { validateReceiver(receiver, index); }
void validate(const FlatlandReceiver& receiver, std::size_t index) { validateReceiver(receiver, index); }

}  // namespace irradiff
