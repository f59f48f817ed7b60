#include "tests/mutants/formula_library.h"

#include <dlfcn.h>
#include <fstream>
#include <map>
#include <stdexcept>

namespace irradiff {
namespace {

std::shared_ptr<void> load(const std::filesystem::path& file) {
  // RTLD_LOCAL: no shared object finds its functions in another one.
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw std::runtime_error(dlerror());
  }
  return {handle, dlclose};
}

template <class Entry>
Entry entryPoint(void* handle, const char* name) {
  void* symbol = dlsym(handle, name);
  if (symbol == nullptr) {
    throw std::runtime_error(dlerror());
  }
  return reinterpret_cast<Entry>(symbol);
}

DerivativeBounds boundsOf(const FormulaAnswer& answer) {
  return {answer.bounds[0], answer.bounds[1], answer.bounds[2], answer.bounds[3], answer.bounds[4]};
}

}  // namespace

FormulaLibrary::FormulaLibrary(std::string name, FormulaGroup group, const std::filesystem::path& file)
    : name_(std::move(name)), group_(group), handle_(load(file)) {
  if (group == FormulaGroup::kSegment) {
    answer_segment_ = entryPoint<decltype(answer_segment_)>(handle_.get(), "answerSegment");
  } else {
    answer_polygon_ = entryPoint<decltype(answer_polygon_)>(handle_.get(), "answerPolygon");
  }
}

FormulaAnswer FormulaLibrary::ask(PolygonFormula formula, const Configuration& configuration) const {
  std::vector<double> vertices;
  for (const Eigen::Vector3d& vertex : configuration.polygon.vertices) {
    vertices.insert(vertices.end(), vertex.begin(), vertex.end());
  }
  FormulaAnswer answer{};
  if (!answer_polygon_(formula, vertices.data(), configuration.polygon.vertices.size(),
                       configuration.receiver.position.data(), configuration.receiver.normal.data(), &answer)) {
    throw std::domain_error("the formula does not accept the input");
  }
  return answer;
}

FormulaAnswer FormulaLibrary::ask(const FlatlandConfiguration& configuration) const {
  const auto& [a, b] = configuration.segment.vertices;
  const double vertices[4] = {a(0), a(1), b(0), b(1)};
  FormulaAnswer answer{};
  if (!answer_segment_(vertices, configuration.receiver.position.data(), configuration.receiver.normal.data(),
                       &answer)) {
    throw std::domain_error("the formula does not accept the input");
  }
  return answer;
}

Candidate FormulaLibrary::candidate(PolygonFormula formula) const {
  // Copies of the library keep it loaded.
  const auto evaluate = [library = *this, formula](const Configuration& c) { return library.ask(formula, c); };
  Candidate candidate;
  candidate.name = name_;
  candidate.form_factor = [evaluate](const Configuration& c) { return evaluate(c).value; };
  candidate.gradient = [evaluate](const Configuration& c) -> Eigen::Vector3d {
    return Eigen::Map<const Eigen::Vector3d>(evaluate(c).gradient);
  };
  candidate.hessian = [evaluate](const Configuration& c) -> Eigen::Matrix3d {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(evaluate(c).hessian);
  };
  if (formula == PolygonFormula::kProduction || formula == PolygonFormula::kEdgeTerms) {
    candidate.tangential_hessian = [evaluate](const Configuration& c) -> Eigen::Matrix2d {
      return Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(evaluate(c).tangential_hessian);
    };
    candidate.rotational_gradient = [evaluate](const Configuration& c) -> Eigen::Vector3d {
      return Eigen::Map<const Eigen::Vector3d>(evaluate(c).rotational_gradient);
    };
  }
  if (formula == PolygonFormula::kProduction) {
    candidate.bounds = [evaluate](const Configuration& c) { return boundsOf(evaluate(c)); };
  }
  return candidate;
}

FlatlandCandidate FormulaLibrary::flatlandCandidate() const {
  const auto evaluate = [library = *this](const FlatlandConfiguration& c) { return library.ask(c); };
  return {name_,
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).value; },
          [evaluate](const FlatlandConfiguration& c) -> Eigen::Vector2d {
            return Eigen::Map<const Eigen::Vector2d>(evaluate(c).gradient);
          },
          [evaluate](const FlatlandConfiguration& c) -> Eigen::Matrix2d {
            return Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(evaluate(c).hessian);
          },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).tangential_hessian[0]; },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).rotational_gradient[0]; },
          [evaluate](const FlatlandConfiguration& c) { return boundsOf(evaluate(c)); }};
}

std::vector<FormulaLibrary> loadFormulaLibraries(const std::filesystem::path& folder) {
  static const std::map<std::string, FormulaGroup> groups = {{"boundary", FormulaGroup::kBoundary},
                                                             {"appendix", FormulaGroup::kAppendix},
                                                             {"production", FormulaGroup::kProduction},
                                                             {"segment", FormulaGroup::kSegment}};
  const std::filesystem::path index = folder / "libraries.txt";
  std::ifstream lines(index);
  std::vector<FormulaLibrary> loaded;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t dot = line.find('.');
    const auto group = groups.find(line.substr(dot + 1));
    if (dot == std::string::npos || group == groups.end()) {
      throw std::runtime_error(index.string() + ": \"" + line + "\" must be a name, a dot and a group of formulas");
    }
    loaded.emplace_back(line.substr(0, dot), group->second, folder / (line + ".so"));
  }
  if (loaded.empty()) {
    throw std::runtime_error(index.string() + ": missing or empty");
  }
  return loaded;
}

}  // namespace irradiff
