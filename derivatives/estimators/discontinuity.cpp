#include "derivatives/estimators/discontinuity.h"

#include "derivatives/estimators/corner_probe.h"
#include "derivatives/estimators/jump_chain.h"
#include "derivatives/estimators/jump_lattice.h"
#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/estimators/radiance_jump.h"
#include "derivatives/estimators/radiance_regions.h"
#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/traced_boundary.h"
#include "derivatives/samples/sample_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

/// Share of the budget for the first lattice.
constexpr double kLatticeShare = 0.45;

/// How often every jump is halved before edges are looked for, so that corners stand out.
constexpr int kHalvingsOfAll = 3;

/// Of the jumps that an edge is fitted through: rounds of halvings, after each of which edges are fitted anew.
constexpr int kRounds = 12;
constexpr int kHalvingsInRound = 4;

/// Jumps are narrowed to this half width, rad: the square root of what a double resolves leaves the depth of an edge
/// about as uncertain as its place.
constexpr double kNarrow = 1e-8;

/// Narrow jumps so far apart, in parts of the edge's length, fix the edge.
constexpr double kFixed = 0.4;

std::vector<TracedChain> traced(const std::vector<JumpChain>& chains, std::span<const RadianceJump> jumps) {
  std::vector<TracedChain> result;
  result.reserve(chains.size());
  for (const JumpChain& chain : chains)
    result.push_back({straightRuns(chain, jumps), chain.jumps.front(), chain.jumps.back(), chain.is_closed});
  return result;
}

void narrowDown(RadianceJump& jump, RayBudget& rays) { jump.narrow(rays.cast(jump.middle())); }

void narrowAll(JumpGraph& graph, RayBudget& rays) {
  for (int i = 0; i < kHalvingsOfAll && graph.jumps.size() <= rays.left(); ++i) {
    for (RadianceJump& jump : graph.jumps) narrowDown(jump, rays);
  }
}

bool isNarrow(const RadianceJump& jump) { return jump.halfWidth() <= kNarrow; }

/// Adds the jumps that fix a run's line and are not narrow yet.
void addWanted(const StraightRun& run, std::span<const RadianceJump> jumps, std::vector<std::size_t>& wanted) {
  const auto isNarrowJump = [&](std::size_t i) { return isNarrow(jumps[i]); };
  const auto first = std::find_if(run.jumps.begin(), run.jumps.end(), isNarrowJump);
  if (first != run.jumps.end()) {
    const auto last = std::find_if(run.jumps.rbegin(), run.jumps.rend(), isNarrowJump);
    const double length = (jumps[run.jumps.front()].middle() - jumps[run.jumps.back()].middle()).norm();
    if ((jumps[*first].middle() - jumps[*last].middle()).norm() > kFixed * length) return;
  }
  for (const std::size_t i : {run.jumps.front(), run.jumps.back()}) {
    if (!isNarrow(jumps[i])) wanted.push_back(i);
  }
}

/// The jumps that fix lines and are not narrow yet, if there are rays for all of them.
std::vector<std::size_t> wantedJumps(std::span<const TracedChain> chains, std::span<const RadianceJump> jumps,
                                     const RayBudget& rays) {
  std::vector<std::size_t> wanted;
  for (const TracedChain& chain : chains) {
    for (const StraightRun& run : chain.runs) addWanted(run, jumps, wanted);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (wanted.size() > rays.left()) wanted.clear();
  return wanted;
}

std::vector<TracedChain> traceEdges(JumpGraph& graph, RayBudget& rays) {
  std::vector<JumpChain> chains = jumpChains(graph);
  std::vector<TracedChain> result = traced(chains, graph.jumps);
  CornerProbe corners;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<std::size_t> wanted = wantedJumps(result, graph.jumps, rays);
    for (int i = 0; i < kHalvingsInRound && wanted.size() <= rays.left(); ++i) {
      for (const std::size_t jump : wanted) narrowDown(graph.jumps[jump], rays);
    }
    if (wanted.empty() && !corners.findCuts(graph, chains, result, rays)) break;
    result = traced(chains, graph.jumps);
  }
  return result;
}

/// What radiance varies beside its jumps, over a mesh as in `triangulated-closed`.
MeshDerivatives smoothDerivatives(const SampleMesh& mesh, const MeshSamples& samples) {
  const bool is_constant =
      std::all_of(samples.radiance.begin(), samples.radiance.end(), [](double radiance) { return radiance == 0.0; });
  if (is_constant || mesh.isEmpty()) return {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  return meshDerivatives(mesh, samples);
}

void addPositionDerivatives(IrradianceEstimate& estimate, const IrradianceDerivatives<double>& traced,
                            const MeshDerivatives& smooth) {
  estimate.gradient = traced.gradient.value + smooth.gradient;
  estimate.knows_normal_component = true;
  estimate.hessian = traced.hessian.value + smooth.hessian;
  estimate.tangential_hessian = traced.tangential_hessian.value + smooth.hessian.topLeftCorner<2, 2>();
}

void requireFinite(const IrradianceEstimate& estimate, std::span<const SeenPoint> nodes) {
  if (estimate.isFinite()) return;
  double nearest = 0.0;
  double brightest = 0.0;
  for (const SeenPoint& node : nodes) {
    nearest = std::max(nearest, node.inverse_distance);
    brightest = std::max(brightest, node.radiance);
  }
  std::ostringstream message;
  message << "discontinuity estimator: the result is beyond the range of double; the lattice's nearest hit has the "
             "inverse distance "
          << nearest << ", its brightest the radiance " << brightest;
  throw std::overflow_error(message.str());
}

/// The nodes of a lattice as arrays.
struct NodeArrays {
  std::vector<double> t, b, n, inverse_distance;

  explicit NodeArrays(std::span<const SeenPoint> nodes) {
    for (const SeenPoint& node : nodes) {
      t.push_back(node.direction(0));
      b.push_back(node.direction(1));
      n.push_back(node.direction(2));
      inverse_distance.push_back(node.inverse_distance);
    }
  }
};

const IrradianceDerivatives<double> kNothingTraced{
    {0.0}, {Eigen::Vector3d::Zero()}, {Eigen::Matrix3d::Zero()}, {Eigen::Matrix2d::Zero()}, {Eigen::Vector3d::Zero()}};

/// Of the traced boundaries and of what radiance varies beside them.
IrradianceEstimate sumOf(const IrradianceDerivatives<double>& traced, const LatticeView& view) {
  IrradianceEstimate estimate;
  estimate.irradiance = traced.irradiance.value;
  Eigen::Vector3d rotational = traced.rotational_gradient.value;
  for (std::size_t i = 0; i < view.nodes.size(); ++i) {
    const Eigen::Vector3d& w = view.nodes[i].direction;
    const double flux = view.smooth_radiance[i] * view.projected_solid_angles[i];
    estimate.irradiance += flux;
    if (flux != 0.0) rotational += flux / w(2) * Eigen::Vector3d(-w(1), w(0), 0.0);
  }
  estimate.rotational_gradient = rotational;
  const NodeArrays arrays(view.nodes);
  const SampleMesh mesh(Stratification::kConcentric, {view.nodes_along_side, view.nodes_along_side},
                        MeshRim::kDownToHorizon);
  addPositionDerivatives(
      estimate, traced,
      smoothDerivatives(mesh, {arrays.t, arrays.b, arrays.n, arrays.inverse_distance, view.smooth_radiance}));
  return estimate;
}

/// Whether an irradiance is one that the nodes of the lattice allow: between the sums over its cells of the least and
/// of the largest radiance at their corners, with the margin to the horizon. Where boundaries are closer than cells,
/// they may be joined the wrong way, and far more is lost or won. What only the refined lattice has seen is not
/// counted.
bool isCredible(double irradiance, const LatticeView& view) {
  constexpr double kRounding = 1e-9;
  const std::size_t side = view.nodes_along_side;
  const double cell = std::numbers::pi / static_cast<double>((side - 1) * (side - 1));
  double least = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i + side < view.nodes.size(); ++i) {
    if (i % side + 1 == side) continue;
    const auto [dark, bright] = std::minmax({view.nodes[i].radiance, view.nodes[i + 1].radiance,
                                             view.nodes[i + side].radiance, view.nodes[i + side + 1].radiance});
    least += dark * cell;
    most += bright * cell;
  }
  return irradiance >= least * (1.0 - kRounding) && irradiance <= most * (1.0 + kRounding);
}

class Discontinuity final : public Estimator {
 public:
  Discontinuity(Stratification stratification, GridShape shape)
      : sums_(stratification, shape), mesh_(stratification, shape, MeshRim::kDownToHorizon) {
    const std::vector<std::size_t>& outermost = mesh_.outermostSamples();
    for (std::size_t k = 0; k < outermost.size(); ++k) {
      rim_.push_back(std::minmax(outermost[k], outermost[(k + 1) % outermost.size()]));
    }
    std::sort(rim_.begin(), rim_.end());
  }

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    IrradianceEstimate result;
    result.irradiance = sums_.irradiance(samples);
    result.rotational_gradient = sums_.rotationalGradient(samples);
    if (mesh_.isEmpty()) return result;
    std::vector<double> region = regionRadiance(samples.radiance, [this](const NeighbourVisitor& visit) {
      forEachEdge([&](std::size_t a, std::size_t b, std::size_t, std::size_t) { visit(a, b); });
    });
    const JumpGraph graph = jumpGraph(samples, region);
    // From here on what is left beside the regions.
    std::vector<double>& smooth = region;
    for (std::size_t i = 0; i < smooth.size(); ++i) smooth[i] = samples.radiance[i] - region[i];
    addPositionDerivatives(result, tracedDerivatives(graph, traced(jumpChains(graph), graph.jumps)),
                           smoothDerivatives(mesh_, {samples.direction_t, samples.direction_b, samples.direction_n,
                                                     samples.inverse_distance, smooth}));
    return result;
  }

 private:
  /// Calls visit(sample, sample, triangle, triangle) for each edge between two samples.
  template <class Visit>
  void forEachEdge(const Visit& visit) const {
    const std::size_t count = mesh_.sampleCount();
    for (const MeshEdges& run : mesh_.edges()) {
      for (std::size_t k = 0; k < run.count; ++k) {
        if (run.start + k < count && run.end + k < count) {
          visit(run.start + k, run.end + k, run.right + k, run.left + k);
        }
      }
    }
  }

  JumpGraph jumpGraph(const HemisphereSamples& samples, const std::vector<double>& region) const {
    const auto seen = [&](std::size_t i) {
      return SeenPoint{samples.direction(i), samples.inverse_distance[i], samples.radiance[i]};
    };
    JumpGraph graph;
    graph.horizon_radiance = region[mesh_.outermostSamples().front()];
    std::vector<std::pair<std::size_t, std::size_t>> jump_of_triangle;
    forEachEdge([&](std::size_t a, std::size_t b, std::size_t right, std::size_t left) {
      if (region[a] == region[b]) return;
      const std::size_t jump = graph.jumps.size();
      graph.jumps.push_back({seen(a), seen(b), region[a], region[b]});
      if (std::binary_search(rim_.begin(), rim_.end(), std::pair<std::size_t, std::size_t>(std::minmax(a, b)))) {
        graph.rim.push_back(jump);
      }
      jump_of_triangle.emplace_back(right, jump);
      jump_of_triangle.emplace_back(left, jump);
    });
    std::sort(jump_of_triangle.begin(), jump_of_triangle.end());
    for (auto first = jump_of_triangle.begin(); first != jump_of_triangle.end();) {
      std::vector<std::size_t> crossed;
      const std::size_t triangle = first->first;
      for (; first != jump_of_triangle.end() && first->first == triangle; ++first) crossed.push_back(first->second);
      // One jump is that of a triangle on the rim, whose third vertex is on the horizon.
      if (crossed.size() == 2) graph.links.push_back({crossed[0], crossed[1]});
      if (crossed.size() == 3) graph.junctions.push_back(std::move(crossed));
    }
    return graph;
  }

  StrataSums sums_;
  SampleMesh mesh_;
  std::vector<std::pair<std::size_t, std::size_t>> rim_;  ///< neighbours on the rim, in ascending order
};

}  // namespace

DiscontinuityEstimate estimateFromDiscontinuities(const RayQuery& query, std::size_t budget, double rotation) {
  if (budget < kFewestDiscontinuityRays) {
    throw std::invalid_argument("discontinuity estimator: a budget of " + std::to_string(budget) +
                                " rays, must be at least " + std::to_string(kFewestDiscontinuityRays));
  }
  if (!std::isfinite(rotation)) {
    throw std::invalid_argument("discontinuity estimator: a rotation of " + std::to_string(rotation) +
                                " rad, must be finite");
  }
  RayBudget rays(query, budget);
  const auto nodes_along_side = static_cast<std::size_t>(std::sqrt(kLatticeShare * static_cast<double>(budget)));
  LatticeView view = viewThroughLattice(rays, nodes_along_side, rotation);
  narrowAll(view.graph, rays);
  const std::vector<TracedChain> chains = traceEdges(view.graph, rays);
  const IrradianceDerivatives<double> derivatives = tracedDerivatives(view.graph, chains);

  DiscontinuityEstimate result;
  result.rays = rays.used();
  result.estimate = sumOf(derivatives, view);
  if (!isCredible(result.estimate.irradiance, view)) {
    for (std::size_t i = 0; i < view.nodes.size(); ++i) view.smooth_radiance[i] = view.nodes[i].radiance;
    result.estimate = sumOf(kNothingTraced, view);
  }
  requireFinite(result.estimate, view.nodes);
  return result;
}

std::unique_ptr<Estimator> makeDiscontinuity(Stratification stratification, GridShape shape) {
  return std::make_unique<Discontinuity>(stratification, shape);
}

}  // namespace irradiff
