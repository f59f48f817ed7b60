#include "experiments/curves/paper_figures.h"

#include "experiments/curves/error_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace irradiff {

namespace {

constexpr const char* kOcclusion = "occlusion-hessian";
constexpr const char* kRadiometric = "radiometric-hessian";
constexpr const char* kGeometric = "geometric-hessian";
constexpr const char* kBounded = "bounded-split-sphere";
/// Section 4.2: 20.5 K isotropic records against 16.5 K anisotropic ones at the same threshold.
constexpr double kPaperIsotropic = 20.5;
constexpr double kPaperAnisotropic = 16.5;

std::string digits(double value, int count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", count, value);
  return text;
}

std::string labelOf(const char* metric, const std::string& rest) {
  std::string label = metric;
  label.append(", ").append(rest);
  return label;
}

bool hasMetric(const RecordField& field, const char* metric) {
  return std::ranges::find(field.metrics, metric) != field.metrics.end();
}

CacheVariant variantOf(const std::string& label, const RecordField& field, const char* metric,
                       std::optional<std::size_t> records) {
  return {label, &field, defaultChoice(field, metric), {}, records};
}

/// The figures in the making: work for several threads, told as it is done.
class PaperFigures {
 public:
  PaperFigures(const PaperFields& fields, std::size_t records, unsigned threads,
               const std::function<void(std::size_t, std::size_t)>& progress)
      : fields_(fields), records_(records), threads_(threads), progress_(progress) {}

  std::vector<CacheComparison> all() {
    if (fields_.box != nullptr) {
      add(figure7());
      add(figure8());
      add(figure9());
      if (fields_.few_rays != nullptr) add(figure10());
    }
    if (fields_.penumbra != nullptr) add(figure11());
    if (fields_.box != nullptr) {
      add(figure12());
      add(figure13());
    }
    if (fields_.black_wall != nullptr) add(figure14());
    return std::move(figures_);
  }

 private:
  static constexpr std::size_t kFigures = 8;

  void add(CacheComparison figure) {
    figures_.push_back(std::move(figure));
    if (progress_) progress_(figures_.size(), kFigures);
  }

  std::vector<VariantResult> run(const std::vector<CacheVariant>& variants) const {
    return runVariants(variants, threads_);
  }

  CacheComparison figure7() const {
    CacheVariant absolute = variantOf("absolute", *fields_.box, kOcclusion, records_);
    absolute.choice.ellipse.scale = ErrorScale::kAbsolute;
    const CacheVariant relative = variantOf("relative", *fields_.box, kOcclusion, records_);
    CacheComparison figure{
        "figure7", "Absolute and relative error", "Radii of the occlusion Hessian.", run({absolute, relative}), {}};
    figure.findings.push_back(errorRatio(figure.results[1], figure.results[0]));
    return figure;
  }

  CacheComparison figure8() const {
    CacheComparison figure{"figure8",
                           "Round and elongated records",
                           "The same threshold with circles and with ellipses of an aspect of at most 2.",
                           {},
                           {}};
    for (const auto& [rule, name] :
         {std::pair(EllipseRule::kPrinted, "printed"), std::pair(EllipseRule::kEqualError, "equal-error")}) {
      CacheVariant ellipses = variantOf(std::string(name) + ", aspect 2", *fields_.box, kOcclusion, records_);
      ellipses.choice.ellipse.rule = rule;
      VariantResult elongated = run({ellipses}).front();
      CacheVariant circles = variantOf(std::string(name) + ", aspect 1", *fields_.box, kOcclusion, std::nullopt);
      circles.choice = ellipses.choice;
      circles.choice.threshold = elongated.threshold;
      circles.choice.ellipse.largest_aspect = 1.0;
      VariantResult round = run({circles}).front();
      figure.findings.push_back(std::string(name) + ": " + std::to_string(round.records) + " round records against " +
                                std::to_string(elongated.records) + " elongated ones, " +
                                digits(static_cast<double>(round.records) / static_cast<double>(elongated.records), 3) +
                                " times as many (the paper: 20.5 K against 16.5 K, " +
                                digits(kPaperIsotropic / kPaperAnisotropic, 3) + ").");
      figure.results.push_back(std::move(round));
      figure.results.push_back(std::move(elongated));
    }
    return figure;
  }

  CacheComparison figure9() const {
    std::vector<CacheVariant> variants;
    for (const char* metric : {kRadiometric, kOcclusion}) {
      if (!hasMetric(*fields_.box, metric)) continue;
      CacheVariant absolute = variantOf(labelOf(metric, "absolute"), *fields_.box, metric, records_);
      absolute.choice.radiance_share = 0.0;
      CacheVariant relative = absolute;
      absolute.choice.ellipse.scale = ErrorScale::kAbsolute;
      relative.label = labelOf(metric, "relative");
      CacheVariant share = relative;
      share.label = labelOf(metric, "relative + 1 %");
      share.choice.radiance_share = 0.01;
      variants.insert(variants.end(), {absolute, relative, share});
    }
    CacheComparison figure{"figure9",
                           "Absolute, relative, and 1 % of the radiance added",
                           "The amendments of Section 4.2, for both Hessians of the radiance.",
                           run(variants),
                           {}};
    for (std::size_t i = 0; i + 2 < figure.results.size(); i += 3) {
      figure.findings.push_back(errorRatio(figure.results[i + 1], figure.results[i]));
      figure.findings.push_back(errorRatio(figure.results[i + 2], figure.results[i + 1]));
    }
    return figure;
  }

  CacheComparison figure10() const {
    const std::string many = std::to_string(fields_.box->rays_per_record) + " rays";
    const std::string few = std::to_string(fields_.few_rays->rays_per_record) + " rays";
    VariantResult with_many = run({variantOf(many, *fields_.box, kOcclusion, records_)}).front();
    CacheVariant variant = variantOf(few, *fields_.few_rays, kOcclusion, std::nullopt);
    variant.choice.threshold = with_many.threshold;
    VariantResult with_few = run({variant}).front();
    VariantResult twin = run({variantOf(labelOf(kBounded, many), *fields_.box, kBounded, records_)}).front();
    const auto compared = [&](const VariantResult& other) {
      const DistributionLikeness like =
          likeness(*fields_.box, with_many.all_radii, with_many.placement, other.all_radii, other.placement);
      return "log radii of all pixels correlate to " + digits(like.radius_correlation, 3) + "; of the records " +
             digits(100.0 * like.density_difference, 2) + " % would have to move to another cell of a grid of " +
             std::to_string(kDensityCells) + " x " + std::to_string(kDensityCells) +
             " (of two random sets of one density " + digits(100.0 * like.chance_difference, 2) + " %).";
    };
    CacheComparison figure{"figure10", "Few rays and many", "The same threshold with a sixteenth of the rays.", {}, {}};
    figure.findings.push_back(few + " against " + many + ": " + std::to_string(with_few.records) + " records against " +
                              std::to_string(with_many.records) + "; " + compared(with_few));
    figure.findings.push_back("For comparison, " + std::string(kBounded) + " against " + kOcclusion + ", both with " +
                              many + ": " + compared(twin));
    figure.results = {std::move(with_few), std::move(with_many), std::move(twin)};
    return figure;
  }

  CacheComparison figure11() const {
    std::vector<CacheVariant> variants;
    for (const char* metric : {kRadiometric, kOcclusion}) {
      variants.push_back(variantOf(metric, *fields_.penumbra, metric, records_));
    }
    CacheComparison figure{
        "figure11",
        "An indirect penumbra",
        "A metric that does not see occlusion, and one that does. Half-axes of records without light are at most a "
        "twelfth of the image: nothing that such a record knows limits it.",
        run(variants),
        {}};
    figure.findings.push_back(errorRatio(figure.results[1], figure.results[0]));
    return figure;
  }

  CacheComparison figure12() const {
    std::vector<CacheVariant> variants;
    const std::array<std::size_t, 4> wanted{500, 1000, 2000, 4000};
    for (const char* metric : {kBounded, kOcclusion}) {
      for (const std::size_t count : possibleCounts(*fields_.box, wanted)) {
        variants.push_back(variantOf(labelOf(metric, std::to_string(count)), *fields_.box, metric, count));
      }
    }
    CacheComparison figure{"figure12",
                           "From few records to many",
                           "Convergence of the bounded split sphere and of the occlusion Hessian.",
                           run(variants),
                           {}};
    const std::size_t half = figure.results.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
      figure.findings.push_back(errorRatio(figure.results[half + i], figure.results[i]));
    }
    return figure;
  }

  CacheComparison figure13() const {
    CacheVariant plain = variantOf(labelOf(kBounded, "as it is"), *fields_.box, kBounded, records_);
    plain.options.has_overture = false;
    CacheVariant helped = plain;
    helped.label = labelOf(kBounded, "3 passes, clamping, overture");
    helped.options.refinement_passes = 3;
    helped.options.clamps_neighbours = true;
    helped.options.has_overture = true;
    CacheVariant occlusion = variantOf(labelOf(kOcclusion, "no overture"), *fields_.box, kOcclusion, records_);
    occlusion.options.has_overture = false;
    CacheVariant overture = occlusion;
    overture.label = labelOf(kOcclusion, "overture");
    overture.options.has_overture = true;
    CacheComparison figure{"figure13",
                           "Refinement, clamping and overture",
                           "What Krivanek et al. 2006 add to the split sphere, and the Hessian without and with an "
                           "overture.",
                           run({plain, helped, occlusion, overture}),
                           {}};
    figure.findings.push_back(errorRatio(figure.results[1], figure.results[0]));
    figure.findings.push_back(errorRatio(figure.results[2], figure.results[1]));
    figure.findings.push_back(errorRatio(figure.results[3], figure.results[2]));
    return figure;
  }

  CacheComparison figure14() const {
    CacheComparison figure{"figure14",
                           "A black back wall",
                           "Contrast that a metric of geometry alone cannot see.",
                           run({variantOf(kGeometric, *fields_.black_wall, kGeometric, records_),
                                variantOf(kOcclusion, *fields_.black_wall, kOcclusion, records_)}),
                           {}};
    figure.findings.push_back(errorRatio(figure.results[1], figure.results[0]));
    return figure;
  }

  static std::string errorRatio(const VariantResult& a, const VariantResult& b) {
    for (const VariantResult* missed : {&a, &b}) {
      if (missed->is_within) continue;
      return missed->label + " cannot have " + std::to_string(missed->asked_records) + " records but " +
             std::to_string(missed->records) + ": nothing to compare.";
    }
    return a.label + " has " + digits(a.error.rms / b.error.rms, 3) + " times the RMS error of " + b.label + " (" +
           std::to_string(a.records) + " and " + std::to_string(b.records) + " records).";
  }

  PaperFields fields_;
  std::size_t records_;
  unsigned threads_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  std::vector<CacheComparison> figures_;
};

}  // namespace

std::vector<CacheComparison> paperFigures(const PaperFields& fields, std::size_t records, unsigned threads,
                                          const std::function<void(std::size_t, std::size_t)>& progress) {
  return PaperFigures(fields, records, threads, progress).all();
}

}  // namespace irradiff
