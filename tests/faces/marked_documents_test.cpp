#include "faces/marked_documents.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Vector3;
using testing::ExpectError;

TEST(MarkedDocuments, JsonOfEveryShape) {
  for (
      const char* text : {
          R"([[1, 2, 3], null, [7, 8, 9]])",
          R"([[[1, 2, 3], [null, null, null], [7, 8, 9]]])",
          R"([{"x": 1, "y": 2, "z": 3}, {"x": null, "y": null, "z": null}, {"x": 7, "y": 8, "z": 9}])",
          R"([{"id": "a", "coordinates": [1, 2, 3]}, {"id": "b", "coordinates": null}, {"id": "c", "coordinates": [7, 8, 9]}])",
          R"({"landmarks": [[1, 2, 3], null, [7, 8, 9]], "mesh": "a.obj"})",
          R"({"points": {"a": [1, 2, 3], "b": null, "c": [7, 8, 9]}})",
          R"({"0": [1, 2, 3], "1": null, "2": [7, 8, 9]})",
          R"({"markups": [{"coordinateSystem": "LPS", "controlPoints": [{"label": "F-1", "position": [1, 2, 3]},
               {"label": "F-2", "position": [0, 0, 0], "positionStatus": "undefined"}, {"position": [7, 8, 9]}]}]})",
      }) {
    const MarkedPoints marked = ParseMarkedJson(text, "a.json");
    ASSERT_EQ(marked.points.size(), 3u) << text;
    EXPECT_EQ(marked.dimension, 3) << text;
    EXPECT_EQ(marked.points[0], Vector3(1, 2, 3)) << text;
    EXPECT_FALSE(marked.points[1]) << text;
    EXPECT_EQ(marked.points[2], Vector3(7, 8, 9)) << text;
  }
  EXPECT_EQ(ParseMarkedJson("[5, -1, 7]", "a").dimension, 1);
  EXPECT_EQ(ParseMarkedJson("[[5, 1], [2, 7]]", "a").dimension, 2);
  EXPECT_EQ(ParseMarkedJson(R"([{"id": 4, "coordinates": [1, 2, 3]}])", "a").labels[0], "4");
  EXPECT_EQ(ParseMarkedJson(R"({"markups": [{"coordinateSystem": "LPS", "controlPoints": []}]})", "a").frame,
            PatientFrame::kLps);
}

TEST(MarkedDocuments, JsonThatIsNoPoints) {
  const auto read = [](const char* text) { return [text] { ParseMarkedJson(text, "a.json"); }; };
  ExpectError(read("[1, 2"), "a.json: not JSON");
  ExpectError(read(R"([[1, 2, 3], "nose"])"), "a.json: point 1: found \"nose\"");
  ExpectError(read(R"([[1, 2, 3], [1, 2]])"), "point 1 has 2 numbers, those before have 3");
  ExpectError(read(R"([[1, 2, 3, 4]])"), "found array of 4 entries");
  ExpectError(read(R"([{"colour": 3}])"), "found object of 1 entries");
  ExpectError(read(R"({"markups": [3]})"), "point 0: found 3");
}

TEST(MarkedDocuments, PickedPointsOfMeshLab) {
  const MarkedPoints marked = ParseMarkedXml(
      "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData><DataFileName name=\"a.ply\"/></DocumentData>\n"
      " <point x=\"1\" y=\"2\" z=\"3e0\" name=\"0\" active=\"1\"/>\n"
      " <point active=\"0\" z=\"0\" y=\"0\" x=\"0\" name=\"1\"/>\n <point x=\"7\" y=\"8\" z=\"9\"/>\n</PickedPoints>\n",
      "a.pp");
  EXPECT_EQ(marked.dimension, 3);
  ASSERT_EQ(marked.points.size(), 3u);
  EXPECT_EQ(marked.points[0], Vector3(1, 2, 3));
  EXPECT_FALSE(marked.points[1]);
  EXPECT_EQ(marked.points[2], Vector3(7, 8, 9));
  EXPECT_EQ(marked.labels[1], "1");
}

TEST(MarkedDocuments, AListThatIsNone) {
  ExpectError([] { ParseMarkedJson("{\"markups\": 5}", "a.json"); }, "\"markups\" is 5, expected a list of markups");
  ExpectError([] { ParseMarkedJson("{\"points\": null}", "a.json"); }, "\"points\" is null, expected a list of points");
}

TEST(MarkedDocuments, PartsOfImglab) {
  const MarkedPoints marked = ParseMarkedXml(
      "<?xml version='1.0'?><dataset><images><image file='a.jpg'><box top='1' left='2' width='9' height='9'>"
      "<part name='00' x='5' y='6'/><part name='01' x='7' y='8'/></box></image></images></dataset>",
      "a.xml");
  EXPECT_EQ(marked.dimension, 2);
  ASSERT_EQ(marked.points.size(), 2u);
  EXPECT_EQ(marked.points[1], Vector3(7, 8, 0));
}

TEST(MarkedDocuments, XmlThatIsNoPoints) {
  const auto read = [](const char* text) { return [text] { ParseMarkedXml(text, "a.pp"); }; };
  ExpectError(read("<PickedPoints><point"), "a.pp: not XML");
  ExpectError(read("<svg/>"), "a.pp: found <svg>");
  ExpectError(read("<PickedPoints><point x=\"1\" y=\"two\" z=\"3\"/></PickedPoints>"),
              "point 0: y=\"two\" is not a number");
  ExpectError(read("<dataset><images><image><box/></image><image><box/></image></images></dataset>"), "several boxes");
}

}  // namespace
}  // namespace daumier::faces
