// generate_room_references FOLDER WIDTH ROOM.json ...: writes FOLDER/ROOM_WIDTH.exr for each room, the true one-bounce
// irradiance that its camera's pixels see. Takes about two milliseconds for each pixel on one core.
#include "experiments/cache_3d/direct_light.h"
#include "experiments/cache_3d/room_reference.h"
#include "experiments/io/whole_file.h"
#include "verification/report/parallel_tasks.h"

#include <cmath>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace irradiff {
namespace {

void generate(const std::filesystem::path& folder, std::size_t width, const std::filesystem::path& path,
              unsigned threads) {
  const Room room = readRoom(path);
  const std::vector<SeenPoint> seen = seenPoints(room, width);
  const SurfaceRadiance radiance = DirectLight(room).tabulated(threads);
  const SliceQuadrature quadrature(room.polygons, radiance);
  RoomReference reference;
  reference.values.resize(seen.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t first = 0; first < seen.size(); first += width) {
    tasks.emplace_back([&, first] {
      for (std::size_t i = first; i < std::min(first + width, seen.size()); ++i) {
        reference.values[i] = quadrature.at(seen[i].receiver);
      }
    });
  }
  runTasks(tasks, threads, {});
  reference.rms_error = referenceError(room, radiance, seen, reference.values, kErrorPoints, threads);
  double mean = 0.0;
  for (const SliceIrradiance& value : reference.values) mean += value.irradiance / static_cast<double>(seen.size());
  std::filesystem::create_directories(folder);
  const std::filesystem::path target = referencePath(folder, room, width);
  WholeFile file(target);
  file.stream() << exrFile(referenceImage(room, width, seen, reference));
  file.commit();
  std::cerr << target.filename().string() << ": mean " << mean << " W/m^2, RMS error " << reference.rms_error / mean
            << " of it\n";
}

}  // namespace
}  // namespace irradiff

int main(int argument_count, char** arguments) {
  if (argument_count < 4) {
    std::cerr << "usage: generate_room_references FOLDER WIDTH ROOM.json ...\n";
    return 2;
  }
  try {
    const std::vector<std::string> given(arguments + 1, arguments + argument_count);
    for (std::size_t i = 2; i < given.size(); ++i) {
      irradiff::generate(given[0], std::stoul(given[1]), given[i], std::max(1U, std::thread::hardware_concurrency()));
    }
  } catch (const std::exception& error) {
    std::cerr << "generate_room_references: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
