#include "gltf/rpm_skeleton.h"

#include <gtest/gtest.h>

namespace daumier::gltf {
namespace {

TEST(RpmSkeleton, IsATPoseOfTheHeightThatIsGiven) {
  GlbBuilder builder(GlbEncoding::kPlain);
  const RpmSkeleton skeleton = AddRpmSkeleton(builder, 1.5);
  const Json& nodes = builder.json()["nodes"];
  EXPECT_EQ(nodes[size_t(skeleton.armature)]["name"], "Armature");
  EXPECT_EQ(nodes[size_t(skeleton.head)]["name"], "Head");
  EXPECT_EQ(nodes.size(), 1u + 52 + 1 + 1) << "the root, the bones, HeadTop_End and the ground";
  std::vector<int> parents(nodes.size(), -1);
  for (size_t n = 0; n < nodes.size(); ++n)
    for (const Json& child : nodes[n].value("children", Json::array())) parents[child.get<size_t>()] = int(n);
  const auto place = [&](const std::string& name) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int node = 0;
    while (nodes[size_t(node)].value("name", "") != name) ++node;
    for (; node >= 0; node = parents[size_t(node)])
      if (nodes[size_t(node)].contains("translation"))
        for (size_t k = 0; k < 3; ++k) sum[Eigen::Index(k)] += nodes[size_t(node)]["translation"][k].get<double>();
    return sum;
  };
  EXPECT_NEAR(place("Head").y(), 1.5, 1e-12);
  EXPECT_NEAR(place("LeftHandIndex3").x(), -place("RightHandIndex3").x(), 1e-12);
  EXPECT_GT(place("LeftHandIndex3").x(), place("LeftHand").x()) << "the avatar's left is +x";
  EXPECT_LT(place("LeftToeBase").y(), 0.05);
}

}  // namespace
}  // namespace daumier::gltf
