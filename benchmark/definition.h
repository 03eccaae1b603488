#pragma once
#include "core/options.h"
#include "datasets/build/faces.h"
#include "datasets/build/portrait_maker.h"
#include "datasets/build/sketches.h"
#include "datasets/styles/style_options.h"

#include <cstdint>
#include <string>
#include <vector>

/// The benchmark kit: inputs, truth and scores by which methods are compared (docs/benchmark.md).
namespace daumier::benchmark {

/// How many persons are in each split; they are drawn in this order, and none is in two.
struct PersonCounts {
  int train = 60, validation = 12, test = 40;

  int all() const { return train + validation + test; }
  template <class V>
  void Visit(V&& visit) {
    visit("train", train, Range{1, 10000}, "Persons on whose faces a method may be trained.");
    visit("validation", validation, Range{1, 10000}, "Persons by whom options are chosen.");
    visit("test", test, Range{1, 10000}, "Persons whom nothing but the last measurement reads.");
  }
};

/// Line drawings of faces, each in three styles.
struct DrawingsOptions {
  int per_person = 2;
  int size = 512;
  double curve_height = 0.62;
  datasets::StyleOptions clean, drawn, rough;

  template <class V>
  void Visit(V&& visit) {
    visit("per_person", per_person, Range{1, 100}, "Faces of a person that are drawn; levels take turns.");
    visit("size", size, Range{64, 2048}, "Pixels a side.");
    visit("curve_height", curve_height, Range{0.2, 1}, "Height of the mean head's curves, as a share of the side.");
    visit("clean", clean, Table{}, "The style `clean`.");
    visit("drawn", drawn, Table{}, "The style `drawn`.");
    visit("rough", rough, Table{}, "The style `rough`.");
  }
};

/// Landmarks of caricatures, in a picture and in space.
struct CaricaturesOptions {
  int per_person = 2;
  double size = 512, yaw = 30, pitch = 12, roll = 8, noise = 0.01;

  template <class V>
  void Visit(V&& visit) {
    visit("per_person", per_person, Range{1, 100}, "Faces of a person, all of the last level.");
    visit("size", size, Range{64, 4096}, "Pixels a side of the picture in which landmarks are given.");
    visit("yaw", yaw, Range{0, 60}, "Greatest turn to a side, degrees.");
    visit("pitch", pitch, Range{0, 45}, "Greatest nod, degrees.");
    visit("roll", roll, Range{0, 45}, "Greatest tilt, degrees.");
    visit("noise", noise, Range{0, 0.2},
          "Standard deviation of each coordinate of a landmark in the picture, as a share of the distance of the outer "
          "eye corners.");
  }
};

struct KitPortraitsOptions {
  int per_person = 2;
  double big_eyes = 0.3;
  datasets::PictureOptions pictures;

  template <class V>
  void Visit(V&& visit) {
    visit("per_person", per_person, Range{1, 100}, "Portraits of a person.");
    visit("big_eyes", big_eyes, Range{0, 1}, "Share of faces whose eyes are enlarged in addition.");
    visit("pictures", pictures, Table{}, "What a portrait looks like.");
  }
};

/// All that a kit is made of. `faces.num_persons` is persons.all(), whatever it says.
struct BenchmarkOptions {
  std::string name = "benchmark";
  PersonCounts persons;
  datasets::FacesOptions faces;
  DrawingsOptions drawings;
  CaricaturesOptions caricatures;
  KitPortraitsOptions portraits;

  template <class V>
  void Visit(V&& visit) {
    visit("name", name, Text{}, "Name and version of the benchmark, which results name.");
    visit("persons", persons, Table{}, "Persons of the splits.");
    visit("faces", faces, Table{}, "Faces, as `daumier dataset faces` has them.");
    visit("drawings", drawings, Table{}, "Drawings.");
    visit("caricatures", caricatures, Table{}, "Landmarks of caricatures.");
    visit("portraits", portraits, Table{}, "Portraits.");
  }
};

}  // namespace daumier::benchmark
