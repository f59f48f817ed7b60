#include "verification/closed_forms/closed_forms.h"

#include "tests/closed_forms/defining_integral.h"
#include "tests/closed_forms/entry_verdict.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>

namespace irradiff::closed_forms_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Only the rectangle over whose corner the element lies has interchangeable sides.
bool sidesMayBeSwapped(const ClosedForm& form, std::size_t i, std::size_t j) {
  return form.title == "parallel rectangle, normal through a corner" && i == 0 && j == 1;
}

TEST(ClosedForms, AgreeWithTheDefiningIntegral) {
  expectAgreement(closedForms(), definingIntegral, sidesMayBeSwapped, 1e-15L);
}

TEST(ClosedForms, ConfigurationsAreValidClockwiseAndAboveTheHorizon) {
  std::mt19937_64 random(kSeed + 1);
  for (const ClosedForm& form : closedForms()) {
    SCOPED_TRACE(form.title);
    for (int set = 0; set < parameterSets(); ++set) {
      const std::vector<double> parameters = drawParameters(form.parameters, random);
      SCOPED_TRACE(describe(form.parameters, parameters));
      const auto [polygon, receiver] = form.configuration(parameters);
      EXPECT_NO_THROW(validate(polygon, 0));
      EXPECT_NO_THROW(validate(receiver, 0));
      EXPECT_EQ(polygon.radiance, 1.0);
      std::vector<Eigen::Vector3d> r;
      for (const auto& vertex : polygon.vertices) r.push_back(vertex - receiver.position);
      EXPECT_GT(r[0].dot(r[1].cross(r[2])), 0.0);
      for (const auto& vertex : r) EXPECT_GE(vertex.dot(receiver.normal), 0.0);
    }
  }
}

TEST(ClosedForms, CoverAtLeastTwelveConfigurations) {
  std::set<std::string_view> titles;
  for (const ClosedForm& form : closedForms()) titles.insert(form.title);
  EXPECT_GE(titles.size(), 12U);
  EXPECT_EQ(titles.size(), closedForms().size()) << "a title names one entry";
}

std::string messageOf(const ClosedForm& form, const std::vector<double>& parameters) {
  try {
    static_cast<void>(form.value(parameters));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(ClosedForms, NameTheParameterThatIsWrong) {
  for (const ClosedForm& form : closedForms()) {
    SCOPED_TRACE(form.title);
    std::vector<double> middle;
    for (const ParameterRange& range : form.parameters) {
      middle.push_back(range.integer ? range.lower : (range.lower + range.upper) / 2);
    }
    EXPECT_EQ(messageOf(form, middle), "no error");
    for (std::size_t i = 0; i < middle.size(); ++i) {
      const auto with = [&](double value) {
        std::vector<double> changed = middle;
        changed[i] = value;
        return messageOf(form, changed);
      };
      const std::string name = "parameter " + std::string(form.parameters[i].name) + " = ";
      EXPECT_THAT(with(std::nan("")), AllOf(HasSubstr(std::string(form.title)), HasSubstr(name + "nan")));
      EXPECT_THAT(with(1e9), HasSubstr(name + "1000000000 must be "));
      EXPECT_THAT(with(-std::numeric_limits<double>::infinity()), HasSubstr(name + "-inf must be "));
      EXPECT_EQ(with(form.parameters[i].upper), "no error");
      EXPECT_EQ(with(form.parameters[i].lower), "no error");
      if (form.parameters[i].integer) {
        EXPECT_THAT(with(form.parameters[i].lower + 0.5), HasSubstr("an integer"));
      }
    }
    middle.pop_back();
    EXPECT_THAT(messageOf(form, middle), HasSubstr("parameters given, but it takes"));
    EXPECT_THROW(static_cast<void>(form.configuration(middle)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace irradiff::closed_forms_test
