#pragma once

#include "experiments/figures/view_evaluation.h"
#include "experiments/io/exr_file.h"
#include "experiments/io/receiver_grid.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// What the values of a channel are like, and so how they are drawn.
enum class ChannelKind {
  kAmount,  ///< >= 0
  kSigned,  ///< of either sign, 0 being special
  kBound,   ///< an upper bound of an error
  kFlag,    ///< 0 or 1
};

struct MapChannel {
  std::string name;     ///< also in the OpenEXR file
  std::string unit;     ///< in plain ASCII, "W/m^2"; empty for a flag
  std::string meaning;  ///< a phrase for people
  ChannelKind kind = ChannelKind::kAmount;
  std::vector<double> values;  ///< row-major in the grid, row 0 at its origin; NaN where the quantity does not exist
};

/// Irradiance and its derivatives at the receivers of a grid, in the grid's frame: x along u, y along v, z along the
/// normal. The channels, in this order:
///   - E, gradient.x, gradient.y, gradient.z;
///   - hessian.xx, hessian.xy, hessian.yy: the tangential Hessian;
///   - lambda1 >= lambda2 >= lambda3: the eigenvalues of the Hessian in space;
///   - bound.E, bound.gradient, bound.tangential_hessian, bound.hessian: upper bounds of the errors of the above in
///     double, each in the max norm of its quantity in the scene's axes or the frame of tangentFrame. In the grid's
///     frame an entry of the gradient is off by up to sqrt(3) times that, one of the tangential Hessian by up to twice,
///     and an eigenvalue by up to 3 times bound.hessian; in a plane z = constant with sides along x and y, the entries
///     by once;
///   - gap.hessian: what the gap-filled scene of the 2012 paper loses of the Hessian in space, max|dH|/max|H|;
///   - event: 1 where the topology of the view differs from that of one of the four neighbours, so that a visibility
///     event passes between the two.
struct DerivativeMap {
  ReceiverGrid grid;
  std::vector<MapChannel> channels;

  /// Throws std::out_of_range naming it if there is none.
  const MapChannel& channel(std::string_view name) const;
};

/// Throws InvalidScene, naming the vector and the rule, unless u and v are not zero and they and the unit normal are
/// perpendicular to each other to within 1e-12, u x v along the normal.
void validateFrame(const ReceiverGrid& grid);

/// The map of a grid, its rows computed on up to `threads` threads; the result does not depend on their number.
/// `progress(done, all)` counts rows; it may be empty, and is never called twice at a time. Throws what the evaluator
/// throws first, and as validateFrame does. Requires width and height of at least 1.
DerivativeMap derivativeMap(const ReceiverGrid& grid, const ViewEvaluator& evaluate, unsigned threads,
                            const std::function<void(std::size_t, std::size_t)>& progress = {});

/// The same channels at any receivers, in the axes of `axes`, whose normal they must have: a map of one row, without
/// events (the channel is 0).
DerivativeMap derivativesAt(std::span<const Receiver> receivers, const ReceiverGrid& axes,
                            const ViewEvaluator& evaluate, unsigned threads,
                            const std::function<void(std::size_t, std::size_t)>& progress = {});

/// The channels of a map, and more over the same grid behind them, as an image without attributes: its rows run from
/// the top, y upwards.
ExrImage exrImage(const DerivativeMap& map, std::span<const MapChannel> more);

}  // namespace irradiff
