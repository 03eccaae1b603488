#pragma once
#include "core/options.h"
#include "faces/appearance/looks.h"

#include <string>
#include <vector>

/// What requests may set of jobs.
namespace daumier::studio {

inline std::vector<std::string> HairWords(std::vector<std::string> words) {
  words.insert(words.end(), faces::kHairStyleNames.begin(), faces::kHairStyleNames.end());
  return words;
}

/// Of rigged heads: the options of `daumier rig` and `avatar` by the same names.
struct HeadJobOptions {
  std::string names = "arkit", hair = "none", hair_colour, clip;
  bool vrm = false, print = false;
  int triangles = 0;

  template <class V>
  void Visit(V&& visit) {
    visit("names", names, Choices{{"arkit", "rpm", "vrm", "unreal", "mediapipe"}}, "Names of targets and nodes.");
    visit("hair", hair, Choices{HairWords({"none", "auto"})}, "Hair; auto: as the picture of an avatar shows it.");
    visit("hair_colour", hair_colour, Text{},
          "Its colour, as #804020 or a name of CSS; empty: the picture's, or a plain one.");
    visit("clip", clip, Text{}, "Upload of a clip that the head plays; empty: one that shows what it can do.");
    visit("vrm", vrm, Flag{}, "Write a .vrm as well.");
    visit("print", print, Flag{}, "Write a closed STL as well.");
    visit("triangles", triangles, Range{0, 1e6}, "Triangles of the head; 0: all.");
  }
};

/// Of avatars: those of heads, and what the picture is made into.
struct AvatarJobOptions {
  std::string as = "auto", style = "none";
  double caricature = 0;
  HeadJobOptions head;

  template <class V>
  void Visit(V&& visit) {
    visit("as", as, Choices{{"auto", "portrait", "drawing"}}, "What the picture is read as.");
    visit("style", style, Choices{{"none", "toon"}}, "What it is made into first.");
    visit("caricature", caricature, Range{0.0, 2.0}, "Share by which the face is exaggerated.");
    head.Visit(visit);
  }
};

/// Of pictures of a face that turns.
struct TurntableOptions {
  int frames = 24, size = 512;

  template <class V>
  void Visit(V&& visit) {
    visit("frames", frames, Range{2, 120}, "Pictures of a whole turn.");
    visit("size", size, Range{64, 2048}, "Pixels a side.");
  }
};

}  // namespace daumier::studio
