#pragma once
#include "faces/finished_head.h"
#include "studio/api.h"
#include "studio/drawn_database.h"
#include "studio/shown_faces.h"

#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace daumier::studio {

struct CollectorOptions {
  std::string person = "1";  ///< Who draws.
  int count = 0;             ///< Faces that the person draws; 0: all.
};

/// @throws UsageError as CheckOutputFolder, unless a collection can be written into the folder.
void CheckCollection(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& inputs);

/// A collection of drawings by hand [Han et al. 2017, section 4.1]: shows faces one by one, front and side, and keeps what a person draws.
/// The folder gets of each drawing drawings/NNNNN.svg and .json (HandDrawing), then faces/ and sketches/ (WriteDrawnDatabase) and
/// manifest.json (kind "collection"), each atomically. Faces come in an order that the person's name decides, those that nobody has drawn
/// first. A later start with the same faces resumes. Thread-safe.
class Collector {
 public:
  /// inputs: folders that are not written into. @throws UsageError as CheckCollection, if the folder is a collection of other faces, or
  /// if the person's name is not 1 to 32 letters, digits, '-' and '_'; Error if a drawing in it is damaged.
  Collector(std::filesystem::path folder, const ShownFaces& faces, const CollectorOptions& options,
            const std::vector<std::filesystem::path>& inputs = {});

  /// {person, done, total, face: {number} or null, next: the same}: drawings of the person, how many are wanted, the face that is shown, and
  /// the one after it.
  Json State() const;
  /// A PNG of a face from "front" or "side". @throws NotFound.
  std::string Picture(int face, const std::string& view);
  /// Puts the face that is shown behind all others and returns the state. Another face: nothing happens.
  Json Skip(int face);
  /// Keeps a drawing {face: number, width, seconds, strokes} of the face that is shown and returns the state. @throws Error as
  /// HandDrawingFromJson, or if another face is shown: then nothing is kept; as WriteDrawnDatabase, after the record was kept.
  Json Add(const Json& body);

  /// Its calls. Valid while it exists.
  const std::vector<Route>& routes() const { return routes_; }

 private:
  struct Kept {
    DrawnFace drawn;
    int face = 0;
    std::string person;
  };
  std::filesystem::path RecordOf(const std::string& name) const;
  HandDrawing Read(const std::string& name) const;
  void ReadKept();
  void FillQueue();
  void WriteDatabase() const;
  void AddRoutes();
  Json StateNow() const;

  const std::filesystem::path folder_;
  const ShownFaces& faces_;
  const CollectorOptions options_;
  const faces::FinishedHead head_;
  mutable std::mutex mutex_;  ///< Of all below but the pictures.
  std::vector<Kept> kept_;    ///< By name.
  std::deque<int> queue_;     ///< The first one is shown.
  std::mutex picture_mutex_;
  std::map<std::pair<int, std::string>, std::string> pictures_;
  std::vector<Route> routes_;
};

}  // namespace daumier::studio
