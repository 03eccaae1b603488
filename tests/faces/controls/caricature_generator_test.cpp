#include "faces/controls/caricature_generator.h"

#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::faces {
namespace {

using geometry::Points;

std::vector<Points> PopulationOf(const FaceModel& model, int count = 40) {
  std::vector<Points> faces;
  for (int i = 0; i < count; ++i) {
    Rng rng = Stream(3, "population", i);
    faces.push_back(IdentityFace(model, DrawIdentity(model, rng)));
  }
  return faces;
}

struct CaricatureSubject {
  FaceModel model = testing::SyntheticModel();
  std::vector<Points> population = PopulationOf(model);
  CaricatureGenerator Generator(const CaricatureOptions& options = {}) const {
    return {model.face_template, population, options, {}};
  }
};

TEST(Caricatures, AnAmountOfZeroIsThePerson) {
  const CaricatureSubject subject;
  const CaricatureGenerator generator = subject.Generator();
  Rng rng = Stream(1, "caricature", 0);
  const Eigen::VectorXd values = generator.DrawValues(subject.population[0], 0, rng);
  EXPECT_EQ(values, Eigen::VectorXd::Zero(generator.controls().num_values()));
  const auto made = generator.Make(subject.population[0], 0, values);
  EXPECT_LT((made.face - subject.population[0]).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Caricatures, ExaggerateWhatDistinguishesThePerson) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.invention = options.group_spread = options.inconsistent = options.asymmetry = options.tendencies = 0;
  options.emphasis = options.crispness = 0;
  const CaricatureGenerator generator = subject.Generator(options);
  for (int person = 0; person < 5; ++person) {
    Rng rng = Stream(1, "caricature", person);
    const Eigen::VectorXd own = generator.fit().ValuesOf(subject.population[person]);
    const Eigen::VectorXd values = generator.DrawValues(subject.population[person], 0.5, rng);
    for (const auto& entry : generator.controls().entries()) {
      for (int k = entry.first_value; k < entry.first_value + entry.num_values(); ++k)
        EXPECT_GE(values[k] * own[k], 0) << entry.control.name;
    }
    const auto made = generator.Make(subject.population[person], 0.5, values);
    const Points deviation = subject.population[person] - generator.fit().mean(),
                 exaggerated = made.face - generator.fit().mean();
    const double cosine = deviation.cwiseProduct(exaggerated).sum() / deviation.norm() / exaggerated.norm();
    EXPECT_GT(cosine, 0.85);
    EXPECT_GT(exaggerated.norm(), deviation.norm());
  }
}

TEST(Caricatures, ValuesOfAllAmountsAreOfTheRange) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.invention = 3;
  const CaricatureGenerator generator = subject.Generator(options);
  Rng rng = Stream(5, "caricature", 0);
  double largest = 0;
  for (int i = 0; i < 30; ++i)
    largest = std::max(largest, generator.DrawValues(subject.population[1], 3, rng).cwiseAbs().maxCoeff());
  EXPECT_LE(largest, kGreatestControlValue);
  EXPECT_GT(largest, 0.9 * kGreatestControlValue);
}

TEST(Caricatures, WithoutAsymmetryLeftAndRightAgree) {
  CaricatureSubject subject;
  const std::vector<int>& mirror = subject.model.face_template.annotation.mirror;
  for (Points& face : subject.population) {
    Points other = face(mirror, Eigen::all);
    other.col(0) *= -1;
    face = (face + other) / 2;
  }
  CaricatureOptions options;
  options.asymmetry = 0;
  const CaricatureGenerator generator = subject.Generator(options);
  Rng rng = Stream(2, "caricature", 0);
  const Eigen::VectorXd values = generator.DrawValues(subject.population[0], 1, rng);
  for (const auto& entry : generator.controls().entries()) {
    if (entry.num_values() == 2) {
      EXPECT_NEAR(values[entry.first_value], values[entry.first_value + 1], 1e-3) << entry.control.name;
    }
  }
}

TEST(Caricatures, NoTriangleOfTheFaceFlips) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.invention = 1;
  const CaricatureGenerator generator = subject.Generator(options);
  const auto& face = subject.model.face_template.annotation.regions.at("face");
  int corrected = 0;
  for (int person = 0; person < 10; ++person) {
    Rng rng = Stream(6, "caricature", person);
    const Eigen::VectorXd drawn = generator.DrawValues(subject.population[person], 3, rng);
    const auto made = generator.Make(subject.population[person], 3, drawn);
    EXPECT_EQ(geometry::CountFlippedTriangles(subject.population[person], made.face,
                                              subject.model.face_template.triangles, face),
              0)
        << person;
    corrected += made.values != drawn;
  }
  EXPECT_GT(corrected, 0) << "the amount is too small to test anything";
}

TEST(Caricatures, LipsDoNotCross) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.invention = 1;
  options.crispness = 0.1;
  const CaricatureGenerator generator = subject.Generator(options);
  const FaceOpenings openings = FindOpenings(subject.model.face_template);
  for (int person = 0; person < 6; ++person) {
    Rng rng = Stream(8, "caricature", person);
    const Points& neutral = subject.population[person];
    const Points made = generator.Make(neutral, 2, generator.DrawValues(neutral, 2, rng)).face;
    EXPECT_LT(CrossingDepth(openings.lips, made), CrossingDepth(openings.lips, neutral) + 0.02) << person;
  }
}

TEST(Caricatures, CrispnessSharpensButForTheMouth) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.crispness = 0.2;
  const CaricatureGenerator generator = subject.Generator(options);
  const Points& neutral = subject.population[0];
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(generator.controls().num_values());
  const Points sharp = generator.Make(neutral, 1, none).face - neutral;
  const auto& landmarks = subject.model.face_template.annotation.landmarks;
  double mouth = 0;
  for (const int i : {51, 57, 62, 66}) mouth = std::max(mouth, sharp.row(landmarks[i]).norm());
  EXPECT_GT(sharp.rowwise().norm().maxCoeff(), 3 * mouth);
  EXPECT_GT(sharp.rowwise().norm().maxCoeff(), 0.05);
}

TEST(Caricatures, InconsistentOnesReverseGroups) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.inconsistent = 1;
  options.invention = options.asymmetry = options.tendencies = 0;
  const CaricatureGenerator generator = subject.Generator(options);
  const Eigen::VectorXd own = generator.fit().ValuesOf(subject.population[2]);
  std::set<int> reversed, kept;
  Rng rng = Stream(9, "caricature", 2);
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd values = generator.DrawValues(subject.population[2], 1, rng);
    for (const auto& entry : generator.controls().entries()) {
      const int k = entry.first_value;
      if (entry.num_values() == 1)
        (values[k] * own[k] < 0 ? reversed : kept).insert(generator.controls().value_groups()[k]);
    }
  }
  EXPECT_GT(reversed.size(), 2u);
  EXPECT_GT(kept.size(), reversed.size());
}

TEST(Caricatures, TheFirstAmountHasToBeZero) {
  const CaricatureSubject subject;
  CaricatureOptions options;
  options.amounts = {1.0};
  testing::ExpectError([&] { subject.Generator(options); }, "caricature.amounts");
}

TEST(Caricatures, AreMadeInSeveralThreads) {
  const CaricatureSubject subject;
  const CaricatureGenerator generator = subject.Generator();
  testing::ExpectTheSameFromThreads(3, [&] {
    Rng rng = Stream(1, "caricature", 4);
    return generator.Make(subject.population[4], 2, generator.DrawValues(subject.population[4], 2, rng)).face;
  });
}

}  // namespace
}  // namespace daumier::faces
