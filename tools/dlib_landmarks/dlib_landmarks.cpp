// Landmarks of the largest face of each picture by dlib's frontal detector and shape predictor [Kazemi and Sullivan 2014],
// as iBUG .pts files. Pictures without a face get no file.
#include <dlib/image_io.h>
#include <dlib/image_processing.h>
#include <dlib/image_processing/frontal_face_detector.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Least score of a face; dlib's own is 0.
double Threshold() {
  const char* const text = std::getenv("DLIB_THRESHOLD");
  return text == nullptr ? 0 : std::atof(text);
}

void WritePts(const fs::path& file, const dlib::full_object_detection& face) {
  std::ofstream out(file);
  out << "version: 1\nn_points: " << face.num_parts() << "\n{\n";
  for (unsigned long i = 0; i < face.num_parts(); ++i) out << face.part(i).x() << ' ' << face.part(i).y() << '\n';
  out << "}\n";
}

int Run(int count, char** words) {
  if (count < 4) {
    std::cerr << "usage: dlib_landmarks MODEL OUT PICTURE...\n";
    return 2;
  }
  dlib::shape_predictor predictor;
  dlib::deserialize(words[1]) >> predictor;
  const fs::path folder = words[2];
  fs::create_directories(folder);
  dlib::frontal_face_detector detector = dlib::get_frontal_face_detector();
  int num_found = 0;
  for (int i = 3; i < count; ++i) {
    dlib::array2d<dlib::rgb_pixel> picture;
    dlib::load_image(picture, words[i]);
    const auto begin = std::chrono::steady_clock::now();
    std::vector<std::pair<double, dlib::rectangle>> faces;
    detector(picture, faces, Threshold());
    if (!faces.empty()) {
      const auto largest = std::max_element(
          faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.second.area() < b.second.area(); });
      WritePts(folder / fs::path(words[i]).filename().replace_extension(".pts"), predictor(picture, largest->second));
      ++num_found;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("%s: %zu faces, %.0f ms\n", words[i], faces.size(), 1000 * seconds);
  }
  std::printf("faces in %d of %d pictures\n", num_found, count - 3);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  try {
    return Run(count, words);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
