#include "tests/mutants/formula_library.h"

#include <dlfcn.h>
#include <fstream>
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
  return {answer.bounds[0], answer.bounds[1], answer.bounds[2]};
}

}  // namespace

FormulaLibrary::FormulaLibrary(std::string name, const std::map<std::string, std::filesystem::path>& libraries)
    : name_(std::move(name)) {
  const auto open = [&](const char* group) {
    handles_.push_back(load(libraries.at(group)));
    return handles_.back().get();
  };
  production_ = entryPoint<PolygonEntry>(open("production"), "answerPolygon");
  templated_ = entryPoint<PolygonEntry>(open("templated"), "answerPolygon");
  segment_ = entryPoint<SegmentEntry>(open("segment"), "answerSegment");
}

FormulaAnswer FormulaLibrary::ask(PolygonFormula formula, const Configuration& configuration) const {
  std::vector<double> vertices;
  for (const Eigen::Vector3d& vertex : configuration.polygon.vertices) {
    vertices.insert(vertices.end(), vertex.begin(), vertex.end());
  }
  const PolygonEntry entry = formula == PolygonFormula::kProduction ? production_ : templated_;
  FormulaAnswer answer{};
  if (!entry(formula, vertices.data(), configuration.polygon.vertices.size(), configuration.receiver.position.data(),
             configuration.receiver.normal.data(), &answer)) {
    throw std::domain_error("the formula does not accept the input");
  }
  return answer;
}

FormulaAnswer FormulaLibrary::ask(const FlatlandConfiguration& configuration) const {
  const auto& [a, b] = configuration.segment.vertices;
  const double vertices[4] = {a(0), a(1), b(0), b(1)};
  FormulaAnswer answer{};
  if (!segment_(vertices, configuration.receiver.position.data(), configuration.receiver.normal.data(), &answer)) {
    throw std::domain_error("the formula does not accept the input");
  }
  return answer;
}

Candidate FormulaLibrary::candidate(PolygonFormula formula) const {
  // Copies of the library keep it loaded.
  const auto evaluate = [library = *this, formula](const Configuration& c) { return library.ask(formula, c); };
  Candidate candidate{name_, nullptr, nullptr, nullptr, nullptr};
  if (formula != PolygonFormula::kEdgeTerms) {
    candidate.form_factor = [evaluate](const Configuration& c) { return evaluate(c).value; };
  }
  candidate.gradient = [evaluate](const Configuration& c) -> Eigen::Vector3d {
    return Eigen::Map<const Eigen::Vector3d>(evaluate(c).gradient);
  };
  candidate.hessian = [evaluate](const Configuration& c) -> Eigen::Matrix3d {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(evaluate(c).hessian);
  };
  if (formula == PolygonFormula::kProduction) {
    candidate.bounds = [evaluate](const Configuration& c) { return boundsOf(evaluate(c)); };
  }
  return candidate;
}

FlatlandCandidate FormulaLibrary::flatlandCandidate() const {
  const auto evaluate = [library = *this](const FlatlandConfiguration& c) { return library.ask(c); };
  return {name_, [evaluate](const FlatlandConfiguration& c) { return evaluate(c).value; },
          [evaluate](const FlatlandConfiguration& c) -> Eigen::Vector2d {
            return Eigen::Map<const Eigen::Vector2d>(evaluate(c).gradient);
          },
          [evaluate](const FlatlandConfiguration& c) -> Eigen::Matrix2d {
            return Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(evaluate(c).hessian);
          },
          [evaluate](const FlatlandConfiguration& c) { return boundsOf(evaluate(c)); }};
}

Eigen::Vector3d FormulaLibrary::rotationalGradient(const Configuration& configuration) const {
  const FormulaAnswer answer = ask(PolygonFormula::kProduction, configuration);
  return Eigen::Map<const Eigen::Vector3d>(answer.rotational_gradient);
}

double FormulaLibrary::rotationalGradient(const FlatlandConfiguration& configuration) const {
  return ask(configuration).rotational_gradient[0];
}

std::vector<FormulaLibrary> loadFormulaLibraries(const std::filesystem::path& folder) {
  const std::filesystem::path index = folder / "libraries.txt";
  std::ifstream lines(index);
  std::vector<std::string> names;
  std::map<std::string, std::map<std::string, std::filesystem::path>> libraries;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t dot = line.find('.');
    const std::string name = line.substr(0, dot);
    if (!libraries.contains(name)) {
      names.push_back(name);
    }
    libraries[name][line.substr(dot + 1)] = folder / (line + ".so");
  }
  if (!libraries.contains("unmutated")) {
    throw std::runtime_error(index.string() + ": no line for the unmutated formulas");
  }
  std::vector<FormulaLibrary> loaded;
  for (const std::string& name : names) {
    std::map<std::string, std::filesystem::path> files = libraries[name];
    files.insert(libraries["unmutated"].begin(), libraries["unmutated"].end());
    loaded.emplace_back(name, files);
  }
  return loaded;
}

}  // namespace irradiff
