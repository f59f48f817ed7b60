#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `cache FILE --output DIR [options]`: an irradiance cache on a room or a scene with a grid, with any error
/// metric. Throws CLI::ValidationError for a wrong call; ends with status 1 where the limit of records was reached or
/// the metric could not have the number of records that was asked for.
void addCacheCommand(CLI::App& app);

}  // namespace irradiff
