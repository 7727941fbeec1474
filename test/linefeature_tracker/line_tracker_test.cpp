// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/line_tracker.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <stdexcept>

#include "common/features/feature_checks.h"
#include "common/geometry/so3.h"
#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

constexpr double kFocal = 458;

LineSegment Segment(const LineObservation& line) { return {line.start, line.end}; }

// Homography of a view that translates, rotates and approaches from image to image.
Eigen::Matrix3d Flight(int i) {
  Eigen::Matrix3d H = Eigen::AngleAxisd(0.008 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  H(0, 2) += 0.006 * i;
  H(1, 2) -= 0.005 * i;
  H(2, 2) -= 0.004 * i;
  H(2, 0) += 0.003 * i;
  return H;
}

// Pairs of adjacent lines that are easily confused, and crossing ones.
LineScene ConfusingScene() {
  LineScene scene(PlainParameters(), 110);
  for (int i = 0; i < 5; ++i)  // 8 px wide, 8 px apart
    scene.AddBar({150, 100.0 + 16 * i}, {330, 120.0 + 16 * i}, 8, 200);
  scene.AddBar({420, 120}, {640, 340}, 20, 30);
  scene.AddBar({640, 120}, {420, 340}, 20, 220);
  scene.AddBar({150, 250}, {330, 420}, 24, 20);
  scene.AddBar({150, 420}, {330, 250}, 24, 230);
  return scene;
}

class LineTrackerTest : public testing::Test {
 protected:
  void Show(LineScene scene, LineTrackerConfig config = {}, const cv::Mat& mask = {}) {
    scene_ = std::make_unique<LineScene>(std::move(scene));
    tracker_ = std::make_unique<LineTracker>(config, scene_->camera(), mask);
  }

  LineFrame Track(const cv::Mat& image,
                  const std::optional<Eigen::Quaterniond>& R_now_then = std::nullopt) {
    t_ns_ += kFrame_ns;
    return tracker_->Track({t_ns_, image}, R_now_then);
  }

  // Index of the edge on which the line lies (in either direction), or -1.
  int EdgeOf(const LineObservation& line, const Eigen::Matrix3d& H) const {
    const auto edges = scene_->Edges(H);
    for (size_t i = 0; i < edges.size(); ++i) {
      if (Relate(edges[i], Segment(line)).overlap > 0.5 &&
          NormalErrorInPixels(edges[i], Segment(line), kFocal) < 1.0)
        return static_cast<int>(i);
    }
    return -1;
  }

  // Statistics of how the lines of a sequence of views follow the edges.
  struct Account {
    int observations = 0;
    int off_edge = 0;   // on no edge
    int switched = 0;   // on another edge than at the start of the track
    int survivors = 0;  // of the first image, in the last one
    int first = 0;      // lines of the first image
    double largest_error_px = 0;
  };

  Account Follow(int images, double noise = 0) {
    Account account;
    std::map<int64_t, int> edge_of_id;
    std::set<int64_t> first;
    for (int i = 0; i < images; ++i) {
      const Eigen::Matrix3d H = Flight(i);
      const LineFrame frame = Track(scene_->View(H, noise));
      for (const LineObservation& line : frame.lines) {
        ++account.observations;
        if (i == 0) first.insert(line.id);
        if (i == images - 1) account.survivors += static_cast<int>(first.count(line.id));
        const int edge = EdgeOf(line, H);
        if (edge < 0) {
          ++account.off_edge;
          continue;
        }
        if (edge_of_id.emplace(line.id, edge).first->second != edge) ++account.switched;
        account.largest_error_px =
            std::max(account.largest_error_px,
                     NormalErrorInPixels(scene_->Edges(H)[edge], Segment(line), kFocal));
      }
    }
    account.first = static_cast<int>(first.size());
    return account;
  }

  std::unique_ptr<LineScene> scene_;
  std::unique_ptr<LineTracker> tracker_;
  int64_t t_ns_ = 0;
};

TEST_F(LineTrackerTest, TracksContinueAfterBlankImages) {
  for (const int blanks : {1, 3, 20}) {
    Show(ConfusingScene());
    std::set<int64_t> before, after;
    for (int i = 0; i < 4; ++i) {
      before.clear();
      for (const LineObservation& line : Track(scene_->View(Flight(0), 1)).lines) {
        before.insert(line.id);
      }
    }
    const cv::Mat blank(480, 752, CV_8U, cv::Scalar(200));
    for (int i = 0; i < blanks; ++i) Track(blank);
    for (const LineObservation& line : Track(scene_->View(Flight(1), 1)).lines) {
      after.insert(line.id);
    }
    size_t continued = 0;
    for (const int64_t id : before) continued += after.count(id);
    EXPECT_GE(before.size(), 10u);
    EXPECT_GT(continued, 0.7 * before.size()) << blanks;
  }
}

TEST_F(LineTrackerTest, FollowsEdgesToTenthsOfAPixel) {
  for (const CameraParameters& parameters : {PlainParameters(), DistortedParameters()}) {
    Show(BarScene(parameters));
    const Account account = Follow(10, 2);
    EXPECT_GE(account.first, 40);
    EXPECT_GE(account.survivors, 0.6 * account.first);
    EXPECT_EQ(account.off_edge, 0);
    EXPECT_EQ(account.switched, 0);
    EXPECT_LT(account.largest_error_px, 0.4);
  }
}

TEST_F(LineTrackerTest, KeepsParallelAndCrossingLinesApart) {
  Show(ConfusingScene());
  const Account account = Follow(10);
  EXPECT_GE(account.first, 14);
  EXPECT_GE(account.survivors, 8);
  EXPECT_EQ(account.switched, 0);
}

TEST_F(LineTrackerTest, NeverReusesIds) {
  Show(BarScene(PlainParameters()));
  std::set<int64_t> ids, previous;
  for (int i = 0; i < 10; ++i) {
    if (i == 5) {
      tracker_->Reset();
      previous.clear();
    }
    std::set<int64_t> current;
    for (const LineObservation& line : Track(scene_->View(Flight(2 * i))).lines) {
      EXPECT_TRUE(current.insert(line.id).second);
      EXPECT_EQ(ids.count(line.id) > 0, previous.count(line.id) > 0) << "a lost line came back";
    }
    ids.insert(current.begin(), current.end());
    previous = current;
  }
  EXPECT_GT(ids.size(), 60U);
}

TEST_F(LineTrackerTest, DirectionsNeverFlip) {
  Show(BarScene(DistortedParameters()));
  std::map<int64_t, LineSegment> before;
  int compared = 0;
  for (int i = 0; i < 8; ++i) {
    for (const LineObservation& line : Track(scene_->View(Flight(i))).lines) {
      const auto it = before.find(line.id);
      if (it != before.end()) {
        EXPECT_LT(DirectedAngle(it->second, Segment(line)), 0.1);
        ++compared;
      }
      before[line.id] = Segment(line);
    }
  }
  EXPECT_GT(compared, 150);
}

TEST_F(LineTrackerTest, KeepsLinesWhereTheMaskAllowsThem) {
  cv::Mat mask(480, 752, CV_8UC1, cv::Scalar(0));
  mask.colRange(0, 376).setTo(255);
  Show(BarScene(PlainParameters()), {}, mask);
  for (int i = 0; i < 6; ++i) {  // lines move out of the allowed half
    const LineFrame frame = Track(scene_->View(Flight(3 * i)));
    EXPECT_GT(frame.lines.size(), 15u);
    for (const LineObservation& line : frame.lines) {
      EXPECT_LT(kFocal * std::max(line.start.x(), line.end.x()) + 375.5, 376 + 2);
    }
  }
}

TEST_F(LineTrackerTest, RotationPredictsLargeTurns) {
  Show(BarScene(PlainParameters()));
  const Eigen::Quaterniond R = SO3Exp({0.05, 0.12, 0.1});  // about 60 px
  const Eigen::Matrix3d H = R.toRotationMatrix();
  const auto kept = [&](const std::optional<Eigen::Quaterniond>& prediction) {
    tracker_->Reset();
    std::map<int64_t, int> edges;
    for (const LineObservation& line : Track(scene_->View()).lines)
      edges[line.id] = EdgeOf(line, Eigen::Matrix3d::Identity());
    int count = 0;
    for (const LineObservation& line : Track(scene_->View(H), prediction).lines) {
      const auto it = edges.find(line.id);
      if (it != edges.end() && it->second == EdgeOf(line, H)) ++count;
    }
    return count;
  };
  EXPECT_GE(kept(R), 25);
  EXPECT_LE(kept(std::nullopt), 8);
}

TEST_F(LineTrackerTest, AThousandLines) {
  LineScene scene(PlainParameters(), 110);
  for (int row = 0; row < 26; ++row) {
    for (int column = 0; column < 13; ++column)
      scene.AddBar({10.0 + 57 * column, 10.0 + 18 * row}, {60.0 + 57 * column, 10.0 + 18 * row}, 8,
                   (row + column) % 2 == 0 ? 220 : 20);
  }
  LineTrackerConfig config;
  config.max_lines = 1000;
  config.half_resolution = false;
  Show(scene, config);
  for (int i = 0; i < 2; ++i) {
    const auto frame = Track(scene_->View());
    EXPECT_GT(frame.lines.size(), 400U);
    EXPECT_LE(frame.lines.size(), 1000U);
  }
  config.max_lines = 60;
  Show(scene, config);
  EXPECT_EQ(Track(scene_->View()).lines.size(), 60U);
}

TEST_F(LineTrackerTest, RejectsUnusableImagesWithoutChange) {
  Show(BarScene(PlainParameters()));
  const cv::Mat image = scene_->View();
  const auto first = Track(image);
  EXPECT_THROW(tracker_->Track({t_ns_ + 1, image(cv::Rect(0, 0, 700, 480))}, std::nullopt),
               std::invalid_argument);
  EXPECT_THROW(tracker_->Track({t_ns_ + 1, cv::Mat(480, 752, CV_8UC3)}, std::nullopt),
               std::invalid_argument);
  EXPECT_THROW(tracker_->Track({t_ns_ + 1, cv::Mat()}, std::nullopt), std::invalid_argument);
  EXPECT_THROW(tracker_->Track({t_ns_, image}, std::nullopt), std::invalid_argument);
  const auto second = Track(image);
  EXPECT_EQ(tracker_->statistics().previous, static_cast<int>(first.lines.size()));
  EXPECT_GE(second.lines.size(), 0.9 * static_cast<double>(first.lines.size()));
}

TEST_F(LineTrackerTest, StatisticsAddUp) {
  Show(BarScene(PlainParameters()));
  size_t before = 0;
  for (int i = 0; i < 6; ++i) {
    const size_t lines = Track(scene_->View(Flight(2 * i))).lines.size();
    const LineTrackerStatistics& s = tracker_->statistics();
    EXPECT_EQ(s.previous, static_cast<int>(before));
    EXPECT_EQ(static_cast<int>(lines),
              s.previous - s.match_lost - s.inconsistent - s.edge_lost - s.duplicates + s.added);
    if (!s.detected) {
      EXPECT_EQ(s.added, 0);
    }
    before = lines;
  }
}

TEST_F(LineTrackerTest, DrawsTheNewestImage) {
  Show(BarScene(PlainParameters()));
  EXPECT_TRUE(tracker_->DrawTracks().empty());
  Track(scene_->View());
  const cv::Mat drawing = tracker_->DrawTracks();
  EXPECT_EQ(drawing.type(), CV_8UC3);
  EXPECT_EQ(drawing.size(), cv::Size(752, 480));
}

// Column 271 of this fisheye is perpendicular to the optical axis, so its rays have no image in z =
// 1.
TEST(LineTracker, IgnoresRaysPerpendicularToTheOpticalAxis) {
  CameraParameters parameters = PlainParameters();
  parameters.model = CameraParameters::Model::kPinholeEquidistant;
  parameters.fx = parameters.fy = 1000;
  parameters.cx = -1300;
  LineTracker tracker({}, CameraModel::Create(parameters));
  cv::Mat image(parameters.height, parameters.width, CV_8UC1, cv::Scalar(60));
  cv::rectangle(image, cv::Rect(120, 150, 147, 180), cv::Scalar(200), cv::FILLED);
  for (int i = 1; i <= 3; ++i) {
    const LineFrame frame = tracker.Track({i * kFrame_ns, image}, std::nullopt);
    EXPECT_FALSE(frame.lines.empty());
    for (const LineObservation& line : frame.lines) EXPECT_TRUE(IsPossible(line)) << line.start;
  }
}

}  // namespace
}  // namespace plm_vins
