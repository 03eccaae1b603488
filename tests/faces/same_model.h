#pragma once
#include "faces/face_model.h"

#include <gtest/gtest.h>

namespace daumier::testing {

inline void ExpectSameTemplate(const faces::FaceTemplate& a, const faces::FaceTemplate& b) {
  EXPECT_EQ(a.source, b.source);
  EXPECT_TRUE(a.neutral == b.neutral);
  EXPECT_TRUE(a.triangles == b.triangles);
  EXPECT_TRUE(a.closing_triangles == b.closing_triangles);
  EXPECT_EQ(a.num_eye_closing_triangles, b.num_eye_closing_triangles);
  EXPECT_TRUE(a.uv == b.uv);
  EXPECT_EQ(a.annotation.landmarks, b.annotation.landmarks);
  EXPECT_EQ(a.annotation.regions, b.annotation.regions);
  EXPECT_EQ(a.annotation.mirror, b.annotation.mirror);
  EXPECT_EQ(a.annotation.curves.size(), b.annotation.curves.size());
}

/// All but the shapes, which may be rounded, and the provenance.
inline void ExpectSameModel(const faces::FaceModel& a, const faces::FaceModel& b) {
  ExpectSameTemplate(a.face_template, b.face_template);
  ASSERT_EQ(a.identity_controls.size(), b.identity_controls.size());
  for (size_t c = 0; c < a.identity_controls.size(); ++c) {
    EXPECT_EQ(a.identity_controls[c].name, b.identity_controls[c].name);
    EXPECT_EQ(a.identity_controls[c].kind, b.identity_controls[c].kind);
    EXPECT_EQ(a.identity_controls[c].shapes, b.identity_controls[c].shapes);
    EXPECT_EQ(a.identity_controls[c].sigma, b.identity_controls[c].sigma);
  }
  EXPECT_EQ(a.align_identities, b.align_identities);
  EXPECT_EQ(a.expression_shape_names, b.expression_shape_names);
  ASSERT_EQ(a.expressions.size(), b.expressions.size());
  for (size_t e = 0; e < a.expressions.size(); ++e) {
    EXPECT_EQ(a.expressions[e].name, b.expressions[e].name);
    EXPECT_TRUE(a.expressions[e].weights == b.expressions[e].weights) << a.expressions[e].name;
  }
  EXPECT_EQ(a.numbering.vertices, b.numbering.vertices);
  EXPECT_EQ(a.numbering.num_vertices, b.numbering.num_vertices);
  EXPECT_EQ(a.numbering.cm_per_unit, b.numbering.cm_per_unit);
}

}  // namespace daumier::testing
