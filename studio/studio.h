#pragma once
#include "studio/api.h"
#include "studio/display_head.h"
#include "studio/job_plans.h"
#include "studio/live_link_receiver.h"

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace daumier::studio {

/// Folders of shipped weights that a studio works with.
struct StudioWeights {
  std::filesystem::path sketch, face_model;
  std::optional<std::filesystem::path> gestures = {};  ///< Without it gestures are not recognised.
  bool has_portraits = false;                          ///< Whether the weights `portrait` and `landmarks` are there.
};

/// All that a studio keeps and computes, as calls of its API (docs/studio.md): drawing sessions, pinned faces, shapes, uploads, jobs, and
/// weights that another program sends to drive a head. Thread-safe.
class Studio {
 public:
  /// folder: sessions/ and faces/ are kept in it, uploads/ and jobs/ emptied. examples: recorded sessions that the page offers, NAME.json; may be
  /// absent. program: the running program. @throws Error as the openers of the weights.
  Studio(const std::filesystem::path& folder, const StudioWeights& weights, const std::filesystem::path& examples,
         std::filesystem::path program);

  /// Valid while the studio exists.
  const std::vector<Route>& routes() const { return routes_; }

  /// From now on packets of Live Link Face drive the head, as POST /api/drive does. To be called before the routes are. @throws UsageError as
  /// LiveLinkReceiver.
  void ReceiveLiveLink(const LiveLinkPlace& place);

 private:
  /// The latest weights of a face tracker.
  struct Drive {
    Json weights;
    std::chrono::steady_clock::time_point when;
  };
  void Add(std::string method, std::string path, std::string summary, std::function<ApiReply(const ApiRequest&)> call,
           Json body = {}, std::string reply = "application/json");
  void AddHead(const StudioWeights& weights);
  void AddSessions();
  void AddFaces();
  void AddShape();
  void AddJobs();
  void AddDrive();
  void SetDrive(Json weights);
  std::string BeginSession(const Json& body);
  geometry::Points FaceOf(const Json& body) { return FaceOfRequest(body, material_); }
  ApiReply VerticesReply(const geometry::Points& face) const;
  ApiReply StateWithFaceReply(const Json& state, const geometry::Points& face) const;

  const std::filesystem::path examples_;
  const std::shared_ptr<const sketch::SketchPredictor> predictor_;
  const DisplayHead display_;
  SketchDesk desk_;
  FaceTray tray_;
  FaceShaper shaper_;
  Uploads uploads_;
  JobMaterial material_;
  std::mutex drive_mutex_;
  std::optional<Drive> drive_;
  std::vector<Route> routes_;
  JobQueue jobs_;                                ///< Jobs use all others.
  std::unique_ptr<LiveLinkReceiver> live_link_;  ///< The last member: its thread uses drive_.
};

}  // namespace daumier::studio
