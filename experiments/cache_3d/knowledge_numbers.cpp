#include "experiments/cache_3d/knowledge_numbers.h"

#include <utility>

namespace irradiff {
namespace {

/// Calls visit(number) for each number of a RecordKnowledge, in one order for writing and reading.
template <class Knowledge, class Visit>
void visitNumbers(Knowledge& known, const Visit& visit) {
  const auto visitAll = [&](auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) visit(matrix.data()[i]);
  };
  visit(known.irradiance);
  visitAll(known.gradient);
  visitAll(known.rotational_gradient);
  visit(known.harmonic_mean_distance);
  visit(known.known_geometry.irradiance);
  visitAll(known.known_geometry.gradient);
  visitAll(known.known_geometry.rotational_gradient);
  for (auto& hessians : known.hessians) {
    visit(hessians.irradiance);
    for (auto* hessian : {&hessians.radiometric, &hessians.geometric, &hessians.occlusion}) {
      visit((*hessian)(0, 0));
      visit((*hessian)(0, 1));
      visit((*hessian)(1, 1));
    }
  }
}

}  // namespace

void appendNumbers(const RecordKnowledge& known, std::vector<double>& numbers) {
  visitNumbers(known, [&](double number) { numbers.push_back(number); });
}

RecordKnowledge knowledgeOf(std::span<const double, kKnowledgeNumbers> numbers) {
  RecordKnowledge known;
  std::size_t next = 0;
  visitNumbers(known, [&](double& number) { number = numbers[next++]; });
  for (MetricHessians& hessians : known.hessians) {
    for (Eigen::Matrix2d* hessian : {&hessians.radiometric, &hessians.geometric, &hessians.occlusion}) {
      (*hessian)(1, 0) = (*hessian)(0, 1);
    }
  }
  return known;
}

void appendNumbers(const ReprojectedError& error, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), error.remainders.begin(), error.remainders.end());
  numbers.insert(numbers.end(), error.hidden.begin(), error.hidden.end());
  numbers.insert(numbers.end(), error.free_distances.begin(), error.free_distances.end());
}

ReprojectedError reprojectedErrorOf(std::span<const double> numbers, std::size_t directions,
                                    std::vector<double> distances) {
  const auto remainders = numbers.first(directions * distances.size());
  const auto hidden = numbers.subspan(remainders.size(), directions);
  const auto free_distances = numbers.last(directions);
  return {std::move(distances), std::vector<float>(remainders.begin(), remainders.end()),
          std::vector<float>(hidden.begin(), hidden.end()),
          std::vector<double>(free_distances.begin(), free_distances.end())};
}

}  // namespace irradiff
