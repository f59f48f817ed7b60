#include "experiments/figures/program_fingerprint.h"

#include "experiments/figures/byte_hash.h"
#include "verification/report/run_record.h"

#include <fstream>
#include <iterator>

namespace irradiff {

std::string programFingerprint() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  return recordOfThisProgram().version + '-' + std::to_string(byteHash(bytes));
}

}  // namespace irradiff
