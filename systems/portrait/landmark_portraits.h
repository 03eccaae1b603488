#pragma once
#include "datasets/read/portrait_database.h"
#include "systems/portrait/landmark_jaw.h"
#include "systems/portrait/landmark_sample.h"

namespace daumier::portrait {

/// The portraits of a database as samples, with an even jaw. The database has to outlive it.
class PortraitSamples : public LandmarkSource {
 public:
  explicit PortraitSamples(const datasets::PortraitDatabase& database) : database_(database) {}

  int size() const override { return database_.size(); }
  LandmarkSample Get(int i) const override {
    return {database_.picture(i),    database_.mask(i),   EvenJaw(database_.landmarks(i)),
            database_.visibility(i), database_.states(i), database_.skin_tone(i)};
  }
  int person(int i) const override { return database_.person(i); }

 private:
  const datasets::PortraitDatabase& database_;
};

}  // namespace daumier::portrait
