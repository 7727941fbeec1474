// SPDX-License-Identifier: BSD-3-Clause
// Measures place recognition on images with known poses, by brute-force comparison of all
// descriptors (the upper bound) and by the index of words with several settings. Prints the recall
// at full precision: the share of true pairs that score above the best false pair. Pairs close in
// time and ambiguous pairs are ignored.
//
// Usage: place_recognition_benchmark CONFIG FOLDER    FOLDER/*.jpg, named by stamp, and poses.tum
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/process_setup.h"
#include "common/stopwatch.h"
#include "pose_graph/description/corner_description.h"
#include "pose_graph/description/corner_selection.h"
#include "pose_graph/retrieval/corner_index.h"

namespace plm_vins {
namespace {

struct Place {
  double t;  // [s]
  Rigid3d T_W_C;
  std::vector<Descriptor> descriptors;
};

// Similarity of two images, and whether they show the same place.
struct Pair {
  double score;
  bool same_place;
};

std::optional<Place> NextPlace(const Rigid3d& T_B_C, std::istream* poses) {
  double t, x, y, z, qx, qy, qz, qw;
  if (!(*poses >> t >> x >> y >> z >> qx >> qy >> qz >> qw)) return std::nullopt;
  const Rigid3d T_W_B(Eigen::Quaterniond(qw, qx, qy, qz).normalized(), Eigen::Vector3d(x, y, z));
  return Place{t, T_W_B * T_B_C, {}};
}

std::vector<Descriptor> Describe(const CameraModel& camera, const Rigid3d& T_W_C,
                                 const cv::Mat& gray) {
  const std::vector<Eigen::Vector2f> corners = SelectCorners(CornerSelectionOptions(), gray, {});
  std::vector<float> angles;
  for (const Eigen::Vector2f& uv : corners) {
    const auto xy = camera.Unproject(uv.cast<double>());
    angles.push_back(xy ? GravityAngle(camera, T_W_C.rotation, *xy) : 0);
  }
  std::vector<Descriptor> descriptors;
  for (const auto& descriptor : DescribeCorners(gray, corners, angles)) {
    if (descriptor) descriptors.push_back(*descriptor);
  }
  return descriptors;
}

std::vector<Place> LoadPlaces(const Config& config, const std::string& folder) {
  const auto camera = CameraModel::Create(config.sensor.cameras[0].parameters);
  std::vector<std::filesystem::path> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".jpg") images.push_back(entry.path());
  }
  std::sort(images.begin(), images.end());
  std::ifstream poses(folder + "/poses.tum");
  std::vector<Place> places;
  const Stopwatch stopwatch;
  for (const auto& image : images) {
    auto place = NextPlace(config.sensor.cameras[0].T_B_C, &poses);
    if (!place) break;
    const cv::Mat gray = cv::imread(image.string(), cv::IMREAD_GRAYSCALE);
    place->descriptors = Describe(*camera, place->T_W_C, gray);
    places.push_back(std::move(*place));
  }
  std::printf("%zu images, %.1f ms each to read and describe\n", places.size(),
              stopwatch.Milliseconds() / static_cast<double>(places.size()));
  return places;
}

// Returns whether two images show the same place; nullopt if ambiguous.
std::optional<bool> SamePlace(const Place& a, const Place& b) {
  const double distance = (a.T_W_C.translation - b.T_W_C.translation).norm();
  const double angle = a.T_W_C.rotation.angularDistance(b.T_W_C.rotation);
  if (std::abs(a.t - b.t) < 15) return std::nullopt;
  if (distance < 1 && angle < 30 * M_PI / 180) return true;
  if (distance > 2 || angle > 60 * M_PI / 180) return false;
  return std::nullopt;
}

// Computes the same scores as CornerIndex, but by comparing all descriptors with each other.
std::map<MapImage, double> ScoresByBruteForce(const std::vector<Place>& places, int query,
                                              int max_distance) {
  std::map<MapImage, double> scores;
  for (const Descriptor& descriptor : places[query].descriptors) {
    std::vector<int> images;
    for (int i = 0; i < query; ++i) {
      const auto& others = places[i].descriptors;
      const bool any = std::any_of(others.begin(), others.end(), [&](const Descriptor& other) {
        return HammingDistance(other, descriptor) <= max_distance;
      });
      if (any) images.push_back(i);
    }
    for (const int image : images) scores[{image, 0}] += std::log((query + 1.0) / images.size());
  }
  return scores;
}

using ScoreFunction = std::function<std::map<MapImage, double>(int query)>;

// Counts the images whose place was shown before, and those whose best candidate shows it.
struct TopHits {
  int queries = 0;
  int hits = 0;

  void Add(const std::vector<Pair>& candidates) {
    const auto same = [](const Pair& pair) { return pair.same_place; };
    if (std::none_of(candidates.begin(), candidates.end(), same)) return;
    ++queries;
    hits +=
        std::max_element(candidates.begin(), candidates.end(), [](const Pair& a, const Pair& b) {
          return a.score < b.score;
        })->same_place;
  }
};

void Measure(const std::string& name, const std::vector<Place>& places,
             const ScoreFunction& scores_of) {
  std::vector<Pair> pairs;
  TopHits top;
  const Stopwatch stopwatch;
  for (size_t i = 0; i < places.size(); ++i) {
    auto scores = scores_of(static_cast<int>(i));
    std::vector<Pair> candidates;
    for (size_t j = 0; j < i; ++j) {
      const auto same_place = SamePlace(places[i], places[j]);
      if (same_place) candidates.push_back({scores[{static_cast<int>(j), 0}], *same_place});
    }
    top.Add(candidates);
    pairs.insert(pairs.end(), candidates.begin(), candidates.end());
  }
  const double ms = stopwatch.Milliseconds() / static_cast<double>(places.size());
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.score > b.score; });
  const auto first_false =
      std::find_if(pairs.begin(), pairs.end(), [](const Pair& pair) { return !pair.same_place; });
  const auto all =
      std::count_if(pairs.begin(), pairs.end(), [](const Pair& pair) { return pair.same_place; });
  std::printf("%-30s %3td of %td pairs at full precision, best of %d of %d images, %.2f ms/image\n",
              name.c_str(), first_false - pairs.begin(), all, top.hits, top.queries, ms);
}

void MeasureIndex(const std::vector<Place>& places, const CornerIndexOptions& options) {
  CornerIndex index(options);
  const std::string name =
      std::to_string(options.tables) + " tables of " + std::to_string(options.bits) + " bits";
  Measure(name, places, [&](int query) {
    auto scores = index.Scores(places[query].descriptors);
    index.Add({query, 0}, places[query].descriptors);
    return scores;
  });
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: place_recognition_benchmark CONFIG FOLDER\n");
    return 1;
  }
  plm_vins::SetUpProcess();
  const auto places = plm_vins::LoadPlaces(plm_vins::LoadConfig(argv[1]), argv[2]);
  for (const int max_distance : {24, 32, 40, 48}) {
    plm_vins::Measure(
        "brute force, " + std::to_string(max_distance) + " of 256 bits", places,
        [&](int query) { return plm_vins::ScoresByBruteForce(places, query, max_distance); });
    for (const int tables : {2, 4}) {
      for (const int bits : {8, 10, 12}) {
        plm_vins::MeasureIndex(places, {tables, bits, max_distance});
      }
    }
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "place_recognition_benchmark: %s\n", error.what());
  return 1;
}
