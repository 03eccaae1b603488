#pragma once
#include "core/options.h"
#include "systems/portrait/landmark_detector.h"

#include <string>

namespace daumier::portrait {

/// Where the data of a run are now.
struct LandmarkEvalData {
  std::string portraits = {};

  template <class V>
  void Visit(V&& visit) {
    visit("portraits", portraits, Text{}, "Folder of the portraits that the run was trained on, if they have moved.");
  }
};

struct LandmarkEvalOptions {
  std::string split = "test";
  LandmarkEvalData data = {};
  int max_portraits = 500;
  std::string pictures = {};
  std::string rival = {};
  std::string negatives = {};
  LandmarkDetectorOptions detector = {};

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "Subset of the run's split that is measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("max_portraits", max_portraits, Range{1, 1e6}, "Largest number of measured portraits, evenly spaced.");
    visit("pictures", pictures, Text{},
          "Folder of other pictures, each with its 68 landmarks in NAME.pts, NAME.txt or NAME.json (nan: not known), "
          "which are measured in addition.");
    visit("rival", rival, Text{},
          "Folder of landmarks that another program found in these pictures, NAME.pts; pictures without one were not "
          "found.");
    visit("negatives", negatives, Text{}, "Folder of pictures without a face; faces that are found in them are false.");
    visit("detector", detector, Table{}, "How faces and landmarks are found.");
  }
};

}  // namespace daumier::portrait
