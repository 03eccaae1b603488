#pragma once
#include "core/json.h"
#include "studio/display_head.h"
#include "studio/face_shaper.h"
#include "studio/face_tray.h"
#include "studio/job_queue.h"
#include "studio/sketch_desk.h"
#include "studio/uploads.h"

#include <filesystem>
#include <memory>

namespace daumier::studio {

/// What jobs work on. All of them outlive the jobs.
struct JobMaterial {
  SketchDesk& desk;
  FaceTray& tray;
  FaceShaper& shaper;
  Uploads& uploads;
  const DisplayHead& display;
  std::filesystem::path program;  ///< The running program, which jobs start again with another verb.
};

/// A face as requests name it, V x 3, cm: {session: id}, {face: id} or {shape: document}. @throws UsageError unless there is one of
/// them, or the session has no face; NotFound.
geometry::Points FaceOfRequest(const Json& body, const JobMaterial& material);
/// The face of a name: a pinned face or a session. @throws NotFound; UsageError as FaceOfRequest.
geometry::Points FaceNamed(const std::string& name, const JobMaterial& material);

/// The job of a request {do: landmarks, avatar, head, drawing, mesh or turntable, ...} (docs/studio.md). A job that a verb of the
/// program does is that verb as a child: it cannot harm the server, ends when it is cancelled, gives its memory back, and its command
/// line is what a person types for the same. @throws UsageError on what is unknown or out of range; NotFound.
NewJob PlanJob(const Json& body, const JobMaterial& material);

/// JSON schema of the request.
Json JobSchema();

}  // namespace daumier::studio
