// What a renderer writes for `irradiff estimate`: 64 x 64 jittered rays of a toy ray caster, as a samples file on
// standard output. Needs nothing of irradiff.
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

struct Rectangle {
  double x0, x1, y0, y1, z, radiance;  // parallel to the floor
};
constexpr Rectangle kScene[] = {{-0.5, 0.5, -0.5, 0.5, 2.0, 10.0}, {-0.1, 0.3, -0.2, 0.15, 1.1, 0.0}};
constexpr double kPosition[] = {0.4, -0.3, 0.0};  // on the floor; the normal is (0, 0, 1)

int main() {
  const int size = 64;
  std::mt19937 random(1);
  const auto jitter = [&random] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
  std::string hits, radiances;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      // The square [-1, 1]^2, columns along its first coordinate, to the disk (Shirley and Chiu 1997) and up.
      const double a = 2.0 * (column + jitter()) / size - 1.0;
      const double b = 2.0 * (row + jitter()) / size - 1.0;
      const bool is_wide = std::abs(a) >= std::abs(b);
      const double radius = is_wide ? a : b;
      const double angle = M_PI / 4.0 * (is_wide ? b / a : 2.0 - a / b);
      const double x = radius * std::cos(angle), y = radius * std::sin(angle), z = std::sqrt(1.0 - x * x - y * y);
      double nearest = INFINITY, radiance = 0.0;
      for (const Rectangle& r : kScene) {
        const double t = (r.z - kPosition[2]) / z, hx = kPosition[0] + t * x, hy = kPosition[1] + t * y;
        if (t < nearest && r.x0 < hx && hx < r.x1 && r.y0 < hy && hy < r.y1) nearest = t, radiance = r.radiance;
      }
      char hit[128] = "null";
      if (std::isfinite(nearest)) {
        std::snprintf(hit, sizeof hit, "[%.17g,%.17g,%.17g]", kPosition[0] + nearest * x, kPosition[1] + nearest * y,
                      kPosition[2] + nearest * z);
      }
      const char* comma = row + column > 0 ? "," : "";
      hits += std::string(comma) + hit;
      radiances += comma + std::to_string(radiance);
    }
  }
  std::printf(R"({"format": "irradiff-samples", "version": 1, "position": [%g,%g,%g], "normal": [0,0,1],)",
              kPosition[0], kPosition[1], kPosition[2]);
  std::printf(R"( "tangent": [1,0,0], "bitangent": [0,1,0], "stratification": "concentric", "shape": [%d,%d],)", size,
              size);
  std::printf(R"( "hits": [%s], "radiance": [%s]})", hits.c_str(), radiances.c_str());
  std::printf("\n");
}
