// SPDX-License-Identifier: MIT
#include "view/error_model.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace vantage {
namespace {

Vec3 turned(double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180.0;
  return {std::cos(angle), std::sin(angle), 0.0};
}

TEST(ErrorModel, TakesAnEstimateForTheScoreBeforeItHasLearnt) {
  ErrorModel model;
  const std::size_t c = model.add(Vec3::UnitX(), 3.0);
  EXPECT_EQ(model.expected(c), 3.0);
  EXPECT_EQ(model.doubt(c), 0.0);
  EXPECT_FALSE(model.knows(c));
}

TEST(ErrorModel, KnowsWhatItWasTold) {
  ErrorModel model;
  const std::size_t c = model.add(Vec3::UnitX(), 3.0);
  model.learn(c, 5.0);
  EXPECT_TRUE(model.knows(c));
  EXPECT_EQ(model.expected(c), 5.0);
  EXPECT_EQ(model.doubt(c), 0.0);
}

TEST(ErrorModel, CarriesAnErrorThatIsTheSameEverywhereToTheFarSide) {
  ErrorModel model;
  const std::size_t far = model.add(-Vec3::UnitX(), 1.0);
  for (int k = 0; k < 4; ++k) {
    model.learn(model.add(turned(20.0 * k), 3.0), 5.0);
  }
  // Its prior variance is 25 against 1.35 of the rest: at least 25 / 26.35 of it is carried over.
  EXPECT_NEAR(model.expected(far), 3.0, 2.0 * (1.0 - 25.0 / 26.35));
}

TEST(ErrorModel, CorrectsNeighboursMoreThanStrangers) {
  ErrorModel model;
  const std::size_t near = model.add(turned(3.0), 0.0);
  const std::size_t far = model.add(turned(90.0), 0.0);
  model.learn(model.add(turned(180.0), 0.0), 0.0);
  model.learn(model.add(turned(0.0), 0.0), 1.0);
  EXPECT_GT(model.expected(near), model.expected(far) + 0.1);
  EXPECT_LT(model.doubt(near), model.doubt(far));
}

TEST(ErrorModel, GivesOneAnswerWhateverTheOrderOfLessonsAndCandidates) {
  const auto expected_after = [](bool candidate_first, bool reversed) {
    ErrorModel model;
    std::size_t asked = candidate_first ? model.add(turned(8.0), 0.5) : 0;
    const std::size_t a = model.add(turned(0.0), 1.0);
    const std::size_t b = model.add(turned(15.0), 2.0);
    model.learn(reversed ? b : a, reversed ? 2.2 : 1.7);
    model.learn(reversed ? a : b, reversed ? 1.7 : 2.2);
    if (!candidate_first) {
      asked = model.add(turned(8.0), 0.5);
    }
    return model.expected(asked);
  };
  const double value = expected_after(true, false);
  EXPECT_NEAR(expected_after(false, false), value, 1e-12);
  EXPECT_NEAR(expected_after(true, true), value, 1e-12);
}

/// Oracle: Gaussian process regression by its textbook formulas, all at once (Rasmussen and
/// Williams, "Gaussian Processes for Machine Learning", 2006, equations 2.25 and 2.26), with the
/// constants of docs/search.md.
struct DenseRegression {
  std::vector<Vec3> taught;
  Eigen::VectorXd errors;  // score − estimate

  static double covariance(const Vec3& a, const Vec3& b) {
    const double t = std::min((a - b).norm() / 0.6, 1.0);
    return 25.0 + std::pow(1.0 - t, 4.0) * (1.0 + 4.0 * t);
  }

  [[nodiscard]] Eigen::LLT<Eigen::MatrixXd> factor(std::size_t count) const {
    const auto size = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd matrix = 0.35 * Eigen::MatrixXd::Identity(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      matrix.col(i) += towards(taught[static_cast<std::size_t>(i)], count);
    }
    return matrix.llt();
  }

  [[nodiscard]] Eigen::VectorXd towards(const Vec3& direction, std::size_t count) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      result[static_cast<Eigen::Index>(i)] = covariance(direction, taught[i]);
    }
    return result;
  }

  /// Mean and variance of the error in a direction after the first lessons, of unit scale.
  [[nodiscard]] std::pair<double, double> at(const Vec3& direction, std::size_t count) const {
    const Eigen::VectorXd k = towards(direction, count);
    const auto matrix = factor(count);
    const Eigen::VectorXd known = errors.head(static_cast<Eigen::Index>(count));
    return {k.dot(matrix.solve(known)), 26.0 - k.dot(matrix.solve(k))};
  }

  /// Mean square of what each lesson but the first added, over the variance that was expected.
  [[nodiscard]] double scale() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < taught.size(); ++i) {
      const auto [mean, variance] = at(taught[i], i);
      const double surprise = errors[static_cast<Eigen::Index>(i)] - mean;
      sum += surprise * surprise / (variance + 0.35);
    }
    return sum / static_cast<double>(taught.size() - 1);
  }
};

TEST(ErrorModel, AgreesWithRegressionSolvedAtOnce) {
  DenseRegression dense;
  constexpr std::size_t kLessons = 15;
  dense.errors.resize(kLessons);
  ErrorModel model;
  for (std::size_t k = 0; k < kLessons; ++k) {
    dense.taught.push_back(turned(11.0 * static_cast<double>(k)));
    const double error = 3.0 + std::sin(7.0 * static_cast<double>(k));
    dense.errors[static_cast<Eigen::Index>(k)] = error;
    model.learn(model.add(dense.taught.back(), 0.25), 0.25 + error);
  }
  for (const double degrees : {-40.0, 4.0, 57.5, 150.0, 230.0}) {
    const std::size_t asked = model.add(turned(degrees), 0.5);
    const auto [mean, variance] = dense.at(turned(degrees), kLessons);
    EXPECT_NEAR(model.expected(asked), 0.5 + mean, 1e-9) << degrees;
    EXPECT_NEAR(model.doubt(asked), std::sqrt(dense.scale() * (variance + 0.35)), 1e-9) << degrees;
  }
}

/// A model that was wrong by 1 in so many directions, 15° apart, up and down by turns.
ErrorModel taught(int lessons) {
  ErrorModel model;
  for (int k = 0; k < lessons; ++k) {
    model.learn(model.add(turned(15.0 * k), 0.0), k % 2 == 0 ? 1.0 : -1.0);
  }
  return model;
}

/// Lessons that say what was expected.
void teach_nothing_new(ErrorModel& model, int lessons) {
  for (int k = 0; k < lessons; ++k) {
    const std::size_t c = model.add(turned(0.1 * k), 0.0);
    model.learn(c, model.expected(c));
  }
}

TEST(ErrorModel, GrowsSurerByItsFirstLessons) {
  ErrorModel model = taught(12);
  const double before = model.noise();
  teach_nothing_new(model, 8);
  EXPECT_LT(model.noise(), before);
}

TEST(ErrorModel, DoesNotGrowSurerByWhatItLearnsOfOneHillLater) {
  ErrorModel model = taught(24);
  const double before = model.noise();
  teach_nothing_new(model, 40);
  EXPECT_EQ(model.noise(), before);
}

TEST(ErrorModel, GrowsLessSureByASurpriseAtAnyTime) {
  ErrorModel model = taught(24);
  const double before = model.noise();
  model.learn(model.add(Vec3::UnitZ(), 0.0), 100.0);
  EXPECT_GT(model.noise(), before);
}

}  // namespace
}  // namespace vantage
