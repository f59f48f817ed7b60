#include "derivatives/estimators/mesh_derivatives.h"

#include "derivatives/boundary/chord_arc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

// The loops below are compiled once for each set of instructions: what they call is inlined, so that it belongs to the
// caller's set. Lanes are summed in the same order whatever their number in an instruction, products and sums are not
// fused: the bits are the same.
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#define IRRADIFF_HAS_VECTOR_TARGETS 1
#else
#define IRRADIFF_HAS_VECTOR_TARGETS 0
#endif
#define IRRADIFF_INLINE [[gnu::always_inline]] inline

namespace irradiff {

namespace {

/// Edges that are evaluated together: a vector of 512 bits, two of 256, four of 128.
constexpr std::size_t kLanes = 8;
using Lanes = std::array<double, kLanes>;

/// With so few jumps among neighbouring edges, those are evaluated together with others' instead.
constexpr std::size_t kFewJumps = 2;

/// |w0 + w1| of two directions that are opposite to rounding: the edge between their points passes through the
/// receiver.
constexpr double kOpposite = 0x1p-50;

/// Square of the sine of the angle to the normal at which a sample has no horizon below it; any direction serves then.
constexpr double kStraightAbove = 0x1p-1000;

/// Every entry of FrameTerms, summed lane by lane.
struct LaneSums {
  alignas(64) Lanes t{}, b{}, n{}, tt{}, tb{}, bb{}, tn{}, bn{}, nn{};
};

IRRADIFF_INLINE void addTerms(LaneSums& sums, std::size_t lane, const FrameTerms<double>& terms) {
  sums.t[lane] += terms.t;
  sums.b[lane] += terms.b;
  sums.n[lane] += terms.n;
  sums.tt[lane] += terms.tt;
  sums.tb[lane] += terms.tb;
  sums.bb[lane] += terms.bb;
  sums.tn[lane] += terms.tn;
  sums.bn[lane] += terms.bn;
  sums.nn[lane] += terms.nn;
}

double total(const Lanes& lanes) {
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

/// Ends of kLanes edges.
struct EndLanes {
  const double* t;
  const double* b;
  const double* n;
  const double* inverse_distance;

  FrameEnd<double> operator[](std::size_t lane) const { return {t[lane], b[lane], n[lane], inverse_distance[lane]}; }
};

struct EndBuffer {
  alignas(64) Lanes t{}, b{}, n{}, inverse_distance{};

  void set(std::size_t lane, const FrameEnd<double>& end) {
    t[lane] = end.t;
    b[lane] = end.b;
    n[lane] = end.n;
    inverse_distance[lane] = end.inverse_distance;
  }
  EndLanes lanes() const { return {t.data(), b.data(), n.data(), inverse_distance.data()}; }
};

/// Edges that are not evaluated where they stand.
struct WaitingEdges {
  EndBuffer start, end;
  alignas(64) Lanes jump{};
  std::size_t count = 0;
};

/// An arc too long for the series is halved until its parts are not: direction, cosine and inverse distance are linear
/// along it.
void addLongArc(LaneSums& sums, std::size_t lane, const FrameEnd<double>& first, const FrameEnd<double>& last,
                double jump) {
  const double square = halfChordSquare(first, last);
  if (square <= ManyChordTerms::kHalfChordSquare) {
    addTerms(sums, lane, chordArcTerms<ManyChordTerms>(first, last, square, jump));
    return;
  }
  const FrameEnd<double> sum{first.t + last.t, first.b + last.b, first.n + last.n,
                             first.inverse_distance + last.inverse_distance};
  const double length = std::sqrt(sum.t * sum.t + sum.b * sum.b + sum.n * sum.n);
  if (!(length > kOpposite)) return;
  const FrameEnd<double> middle{sum.t / length, sum.b / length, sum.n / length, sum.inverse_distance / length};
  addLongArc(sums, lane, first, middle, jump);
  addLongArc(sums, lane, middle, last, jump);
}

template <class Terms>
IRRADIFF_INLINE void addShortArcs(LaneSums& sums, const EndLanes& start, const EndLanes& end, const Lanes& squares,
                                  const Lanes& jumps) {
#pragma omp simd
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    addTerms(sums, lane, chordArcTerms<Terms>(start[lane], end[lane], squares[lane], jumps[lane]));
  }
}

IRRADIFF_INLINE void addArcs(LaneSums& sums, const EndLanes& start, const EndLanes& end, Lanes& jumps) {
  alignas(64) Lanes squares;
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    squares[lane] = halfChordSquare<double>({start.t[lane], start.b[lane], start.n[lane], 0.0},
                                            {end.t[lane], end.b[lane], end.n[lane], 0.0});
    largest = std::max(largest, squares[lane]);
    jumps[lane] = start.n[lane] + end.n[lane] > 0.0 ? jumps[lane] : 0.0;  // arcs of the horizon add nothing
  }
  if (largest <= FewChordTerms::kHalfChordSquare) {
    addShortArcs<FewChordTerms>(sums, start, end, squares, jumps);
    return;
  }
  if (!(largest <= ManyChordTerms::kHalfChordSquare)) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (squares[lane] <= ManyChordTerms::kHalfChordSquare) continue;
      if (jumps[lane] != 0.0) addLongArc(sums, lane, start[lane], end[lane], jumps[lane]);
      jumps[lane] = 0.0;
    }
  }
  addShortArcs<ManyChordTerms>(sums, start, end, squares, jumps);
}

/// Where the horizon is below the outermost samples.
struct HorizonDirections {
  std::vector<double> t, b;

  HorizonDirections(const MeshSamples& samples, const std::vector<std::size_t>& outermost) {
    t.reserve(outermost.size());
    b.reserve(outermost.size());
    for (const std::size_t sample : outermost) {
      const double square = samples.t[sample] * samples.t[sample] + samples.b[sample] * samples.b[sample];
      const double inverse = 1.0 / std::sqrt(square);
      const bool is_above = square < kStraightAbove;
      t.push_back(is_above ? 1.0 : samples.t[sample] * inverse);
      b.push_back(is_above ? 0.0 : samples.b[sample] * inverse);
    }
  }
};

/// A mesh with its numbers.
struct MeshInput {
  const SampleMesh* mesh = nullptr;
  const MeshSamples* samples = nullptr;
  const HorizonDirections* horizon = nullptr;

  std::size_t sampleCount() const { return samples->t.size(); }
  FrameEnd<double> vertex(std::size_t number) const {
    if (number >= sampleCount()) {
      return {horizon->t[number - sampleCount()], horizon->b[number - sampleCount()], 0.0, 0.0};
    }
    return {samples->t[number], samples->b[number], samples->n[number], samples->inverse_distance[number]};
  }
  /// The sample whose radiance and distance a vertex has where triangles are concerned.
  std::size_t sampleOf(std::size_t number) const {
    return number < sampleCount() ? number : mesh->outermostSamples()[number - sampleCount()];
  }
  EndLanes sampleLanes(std::size_t first) const {
    return {samples->t.data() + first, samples->b.data() + first, samples->n.data() + first,
            samples->inverse_distance.data() + first};
  }
};

/// Radiance of the farthest of three corners, in the unit of radiance.
IRRADIFF_INLINE double farthestRadiance(double distance0, double distance1, double distance2, double radiance0,
                                        double radiance1, double radiance2) {
  const bool is_second = distance1 < distance0;
  const double distance = is_second ? distance1 : distance0;
  const double radiance = is_second ? radiance1 : radiance0;
  return distance2 < distance ? radiance2 : radiance;
}

/// Into result[triangle]; 0 for what is outside.
IRRADIFF_INLINE void triangleRadiances(const MeshInput& input, std::vector<double>& result) {
  const std::size_t sample_count = input.sampleCount();
  const double* distance = input.samples->inverse_distance.data();
  const double* radiance = input.samples->radiance.data();
  for (const MeshTriangles& run : input.mesh->triangles()) {
    const std::size_t i = run.corners[0];
    const std::size_t j = run.corners[1];
    const std::size_t k = run.corners[2];
    double* out = result.data() + run.first;
    if (std::max({i, j, k}) + run.count <= sample_count) {
#pragma omp simd
      for (std::size_t c = 0; c < run.count; ++c) {
        out[c] = farthestRadiance(distance[i + c], distance[j + c], distance[k + c], radiance[i + c], radiance[j + c],
                                  radiance[k + c]);
      }
      continue;
    }
    for (std::size_t c = 0; c < run.count; ++c) {
      const std::size_t first = input.sampleOf(i + c);
      const std::size_t second = input.sampleOf(j + c);
      const std::size_t third = input.sampleOf(k + c);
      out[c] = farthestRadiance(distance[first], distance[second], distance[third], radiance[first], radiance[second],
                                radiance[third]);
    }
  }
}

IRRADIFF_INLINE void addWaiting(LaneSums& sums, WaitingEdges& waiting) {
  // What is left of earlier edges in the other lanes counts 0 times.
  for (std::size_t lane = waiting.count; lane < kLanes; ++lane) waiting.jump[lane] = 0.0;
  addArcs(sums, waiting.start.lanes(), waiting.end.lanes(), waiting.jump);
  waiting.count = 0;
}

IRRADIFF_INLINE void wait(LaneSums& sums, WaitingEdges& waiting, const MeshInput& input, std::size_t start,
                          std::size_t end, double jump) {
  waiting.start.set(waiting.count, input.vertex(start));
  waiting.end.set(waiting.count, input.vertex(end));
  waiting.jump[waiting.count] = jump;
  if (++waiting.count == kLanes) addWaiting(sums, waiting);
}

IRRADIFF_INLINE void addEdges(LaneSums& sums, const MeshInput& input, const std::vector<double>& radiances) {
  const std::size_t sample_count = input.sampleCount();
  WaitingEdges waiting;
  for (const MeshEdges& run : input.mesh->edges()) {
    const double* right = radiances.data() + run.right;
    const double* left = radiances.data() + run.left;
    if (run.count < kLanes || std::max(run.start, run.end) + run.count > sample_count) {
      for (std::size_t k = 0; k < run.count; ++k) {
        const double jump = right[k] - left[k];
        if (jump != 0.0) wait(sums, waiting, input, run.start + k, run.end + k, jump);
      }
      continue;
    }
    for (std::size_t done = 0; done < run.count; done += kLanes) {
      // The last lanes of a run overlap the ones before, which then count 0 times.
      const std::size_t first = std::min(done, run.count - kLanes);
      alignas(64) Lanes jumps;
      std::size_t jump_count = 0;
#pragma omp simd reduction(+ : jump_count)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        jumps[lane] = first + lane < done ? 0.0 : right[first + lane] - left[first + lane];
        jump_count += jumps[lane] != 0.0 ? 1 : 0;
      }
      if (jump_count == 0) continue;
      if (jump_count <= kFewJumps) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if (jumps[lane] == 0.0) continue;
          wait(sums, waiting, input, run.start + first + lane, run.end + first + lane, jumps[lane]);
        }
        continue;
      }
      addArcs(sums, input.sampleLanes(run.start + first), input.sampleLanes(run.end + first), jumps);
    }
  }
  if (waiting.count > 0) addWaiting(sums, waiting);
}

/// Products of five numbers and their sums stay well within the range of double up to here.
constexpr int kModerateExponent = 150;

/// Brings numbers near 1 by a power of two if their largest is not moderate: they become a view of `copy`. Returns the
/// power's exponent, 0 if the numbers stay as they are.
IRRADIFF_INLINE int scale(std::span<const double>& values, std::vector<double>& copy) {
  const double* numbers = values.data();
  const std::size_t count = values.size();
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t i = 0; i < count; ++i) largest = numbers[i] > largest ? numbers[i] : largest;
  if (largest == 0.0) return 0;
  // The inverse is to be finite.
  const int exponent = std::max(std::ilogb(largest), -1000);
  if (std::abs(exponent) <= kModerateExponent) return 0;
  copy.assign(values.begin(), values.end());
  for (double& value : copy) value = std::ldexp(value, -exponent);
  values = copy;
  return exponent;
}

IRRADIFF_INLINE MeshDerivatives derivativesOf(MeshInput input) {
  MeshSamples samples = *input.samples;
  std::vector<double> scaled_distances;
  std::vector<double> scaled_radiances;
  const int distance_exponent = scale(samples.inverse_distance, scaled_distances);
  const int radiance_exponent = scale(samples.radiance, scaled_radiances);
  input.samples = &samples;
  std::vector<double> radiances(input.mesh->triangleCount() + 1);
  triangleRadiances(input, radiances);
  LaneSums sums;
  addEdges(sums, input, radiances);
  const int gradient_exponent = radiance_exponent + distance_exponent;
  const int hessian_exponent = gradient_exponent + distance_exponent;
  const auto entry = [](const Lanes& lanes, int exponent) { return std::ldexp(total(lanes), exponent); };
  MeshDerivatives result;
  result.gradient << entry(sums.t, gradient_exponent), entry(sums.b, gradient_exponent),
      entry(sums.n, gradient_exponent);
  const double tb = 0.5 * entry(sums.tb, hessian_exponent);
  const double tn = 0.5 * entry(sums.tn, hessian_exponent);
  const double bn = 0.5 * entry(sums.bn, hessian_exponent);
  result.hessian << entry(sums.tt, hessian_exponent), tb, tn, tb, entry(sums.bb, hessian_exponent), bn, tn, bn,
      entry(sums.nn, hessian_exponent);
  return result;
}

#if IRRADIFF_HAS_VECTOR_TARGETS
#if defined(__clang__)
#define IRRADIFF_AVX512 "avx512f,avx512dq,avx512vl"
#else
#define IRRADIFF_AVX512 "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif
[[gnu::target("avx2")]] MeshDerivatives derivativesByAvx2(const MeshInput& input) { return derivativesOf(input); }
[[gnu::target(IRRADIFF_AVX512)]] MeshDerivatives derivativesByAvx512(const MeshInput& input) {
  return derivativesOf(input);
}
#endif

MeshDerivatives derivativesByAnyMachine(const MeshInput& input) { return derivativesOf(input); }

}  // namespace

std::vector<VectorInstructions> vectorInstructions() {
  std::vector<VectorInstructions> available{VectorInstructions::kNone};
#if IRRADIFF_HAS_VECTOR_TARGETS
  if (__builtin_cpu_supports("avx2")) available.push_back(VectorInstructions::kAvx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    available.push_back(VectorInstructions::kAvx512);
  }
#endif
  return available;
}

MeshDerivatives meshDerivatives(const SampleMesh& mesh, const MeshSamples& samples, VectorInstructions instructions) {
  const bool is_closed = !mesh.horizonEdges().empty();
  const HorizonDirections horizon(samples, is_closed ? mesh.outermostSamples() : std::vector<std::size_t>());
  MeshInput input;
  input.mesh = &mesh;
  input.samples = &samples;
  input.horizon = &horizon;
  switch (instructions) {
#if IRRADIFF_HAS_VECTOR_TARGETS
    case VectorInstructions::kAvx2:
      return derivativesByAvx2(input);
    case VectorInstructions::kAvx512:
      return derivativesByAvx512(input);
#endif
    default:
      return derivativesByAnyMachine(input);
  }
}

}  // namespace irradiff
