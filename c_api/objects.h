#pragma once
#include "c_api/daumier.h"
#include "core/error.h"
#include "faces/face_model.h"
#include "faces/face_model_file.h"
#include "fitting/code_handles.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "systems/deform/open_code_model.h"
#include "systems/system.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

/// What the handles of daumier.h are.

struct daumier_predictor {
  const daumier::systems::System& system;
  std::unique_ptr<const daumier::systems::Predictor> predictor;
};

struct daumier_face {
  daumier::systems::FaceResult result;
  std::string record;  ///< As JSON.
};

struct daumier_model {
  daumier::deform::OpenedModel opened;
};

struct daumier_edit {
  daumier::geometry::Points face, of_code;  ///< V x 3, cm: the face, and what the model makes of it.
  const daumier::fitting::CodeModel& model;
  daumier::fitting::HandleEditor editor;
};

struct daumier_rig {
  daumier::faces::FaceModel model;
  daumier::rig::ExpressionTargets expressions;
  daumier::rig::HeadRig rig;
};

struct daumier_head {
  daumier::rig::RiggedHead head;
};
