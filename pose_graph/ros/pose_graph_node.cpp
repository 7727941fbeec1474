// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/pose_graph_node.h"

#include <ros/parameter_adapter.h>

#include <exception>
#include <filesystem>
#include <utility>

#include "common/append.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/names.h"
#include "common/ros/parameter.h"
#include "common/ros/publish_if_wanted.h"
#include "common/stopwatch.h"
#include "pose_graph/output/map_file.h"
#include "pose_graph/ros/loop_drawing.h"
#include "pose_graph/ros/map_messages.h"

namespace plm_vins {
namespace {

constexpr char kEstimator[] = "vins_estimator/";
constexpr int kQueue = 100;
constexpr size_t kWaitingKeyframes = 50;
constexpr double kMaxLag = 2;  // lag of keyframes behind the images [s]

std::string MapFile(PoseGraphConfig config, const ros::NodeHandle& private_node) {
  const auto output = FindParameter<std::string>(private_node, "output");
  if (config.save_path.empty() && output) config.save_path = *output;
  const auto named = FindParameter<std::string>(private_node, "map_file").value_or("");
  const std::filesystem::path file = named.empty() ? config.MapFile() : named;
  return std::filesystem::absolute(file).lexically_normal().string();
}

KeyframeMap MapToStartIn(const std::string& file) {
  PreviousMap previous = LoadPreviousMap(file);
  if (!previous.warning.empty()) ROS_WARN("%s", previous.warning.c_str());
  return std::move(previous.map);
}

}  // namespace

PoseGraphNode::PoseGraphNode(const Config& config, const ros::NodeHandle& node,
                             const ros::NodeHandle& private_node)
    : node_(node),
      private_node_(private_node),
      receiver_(in_place_.Receiver(node)),
      config_(config),
      cameras_(CreateAll(config.sensor.cameras)),
      map_file_(MapFile(config.pose_graph, private_node)),
      input_(config.sensor),
      queue_(kWaitingKeyframes),
      odometry_publisher_(private_node_.advertise<nav_msgs::Odometry>("odometry", kQueue)),
      match_publisher_(private_node_.advertise<sensor_msgs::Image>("match_image", 10)),
      diagnostics_(node, private_node, private_node.getNamespace()) {
  StartWith(config.pose_graph.load_previous ? MapToStartIn(map_file_) : KeyframeMap());
  diagnostics_.setHardwareID("none");
  diagnostics_.add("map", this, &PoseGraphNode::ReportStatus);
  AdvertiseMap();
  Subscribe();
  worker_ = std::thread(&PoseGraphNode::Work, this);  // last: an exception after it would abort
}

PoseGraphNode::~PoseGraphNode() {
  queue_.Abandon();
  worker_.join();
}

// A new subscriber gets the current map, as from a latched topic. Latched topics would build these
// messages without subscribers, at a cost that grows with the map.
void PoseGraphNode::AdvertiseMap() {
  const auto advertise = [this](const char* topic, const auto& make) {
    using Message = decltype(make());
    return private_node_.advertise<Message>(
        topic, 10, [this, make](const ros::SingleSubscriberPublisher& subscriber) {
          const std::lock_guard<std::mutex> lock(loops_mutex_);
          subscriber.publish(make());
        });
  };
  path_publisher_ = advertise("path", [this] { return Path(); });
  graph_publisher_ = advertise("graph", [this] { return Graph(); });
}

// Runs callbacks in the receiving thread (InPlaceQueue): waking a thread of its own for each
// message costs more than processing it.
template <typename Parameter>
ros::Subscriber PoseGraphNode::Receive(const std::string& topic,
                                       const boost::function<void(Parameter)>& callback) {
  using Message = typename ros::ParameterAdapter<Parameter>::Message;
  return receiver_.subscribe<Message, Parameter>(topic, kQueue, callback);
}

template <typename Parameter>
ros::Subscriber PoseGraphNode::Receive(const std::string& topic,
                                       void (PoseGraphNode::*add)(Parameter)) {
  const boost::function<void(Parameter)> callback = [this, add](Parameter message) {
    TakeIn([&] { (this->*add)(message); });
  };
  return Receive(topic, callback);
}

void PoseGraphNode::TakeIn(const std::function<void()>& add) {
  const std::lock_guard<std::mutex> lock(input_mutex_);
  errors_.Run(add);
}

// Publishes without holding input_mutex_: publishing takes a lock of ROS, which a driver in this
// process may hold while its image waits here for input_mutex_.
void PoseGraphNode::PassOnInMap(const OdometryEvent& event) {
  std::optional<MapFix> fix;
  TakeIn([&] { fix = AddOdometry(event); });
  if (fix) errors_.Run([&] { PublishInMap(*event.getMessage(), *fix); });
}

void PoseGraphNode::PublishInMap(const nav_msgs::Odometry& odometry, const MapFix& fix) {
  const std::string& map_frame = config_.output.map_frame;
  odometry_publisher_.publish(ToMap(odometry, fix, map_frame));
  if (!config_.output.publish_tf) return;
  const auto header = MakeHeader(ToNanoseconds(odometry.header.stamp), map_frame);
  broadcaster_.sendTransform(ToTransform(header, odometry.header.frame_id, fix.T_M_O.ToRigid()));
}

void PoseGraphNode::Subscribe() {
  const std::string estimator = kEstimator;
  const boost::function<void(const OdometryEvent&)> pass_on = [this](const OdometryEvent& event) {
    PassOnInMap(event);
  };
  subscribers_ = {Receive(estimator + "keyframe_pose", &PoseGraphNode::AddPose),
                  Receive(estimator + "keyframe_point", &PoseGraphNode::AddPoints),
                  Receive(estimator + "keyframe_line", &PoseGraphNode::AddLines),
                  Receive(estimator + "odometry", pass_on),
                  Receive(estimator + "restart", &PoseGraphNode::Restart)};
  SubscribeToCameras();
  services_ = {private_node_.advertiseService("save_map", &PoseGraphNode::SaveMapFile, this),
               private_node_.advertiseService("load_map", &PoseGraphNode::LoadMapFile, this),
               private_node_.advertiseService("reset", &PoseGraphNode::Reset, this)};
  diagnostics_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void PoseGraphNode::SubscribeToCameras() {
  for (const int camera : input_.cameras()) {
    const boost::function<void(const sensor_msgs::CameraInfo&)> refine =
        [this, camera](const auto& message) { TakeIn([&] { input_.AddCamera(camera, message); }); };
    const boost::function<void(const nav_msgs::Odometry&)> move = [this,
                                                                   camera](const auto& message) {
      TakeIn([&] { input_.AddExtrinsics(camera, message); });
    };
    subscribers_.push_back(Receive(kEstimator + NameOfCamera("camera_info", camera), refine));
    subscribers_.push_back(Receive(kEstimator + NameOfCamera("extrinsic", camera), move));
    const std::string name = camera == 0 ? "images" : "camera" + std::to_string(camera) + "_images";
    image_subscriptions_.push_back(std::make_unique<ImageSubscription>(name));
    image_subscriptions_.back()->Subscribe(receiver_, private_node_,
                                           config_.sensor.cameras[camera].image_topic, kQueue,
                                           [this, camera](const std::optional<ImageSample>& image) {
                                             TakeIn([&] { AddImage(camera, image); });
                                           });
  }
}

void PoseGraphNode::AddImage(int camera, const std::optional<ImageSample>& image) {
  if (image) input_.AddImage(camera, *image);
  PassOn();
}

void PoseGraphNode::AddPose(const OdometryEvent& event) {
  if (estimator_.HasChanged(kKeyframePoses, event.getConnectionHeaderPtr())) {
    NoteNewWorld("keyframes come from another estimator");
  }
  keyframe_stream_.Add(ToNanoseconds(event.getMessage()->header.stamp));
  input_.AddPose(*event.getMessage());
  PassOn();
}

void PoseGraphNode::AddPoints(const sensor_msgs::PointCloud& message) {
  input_.AddPoints(message);
  PassOn();
}

void PoseGraphNode::AddLines(const sensor_msgs::PointCloud& message) {
  input_.AddLines(message);
  PassOn();
}

void PoseGraphNode::PassOn() {
  while (auto frame = input_.Pop()) {
    if (queue_.PushOverOldest({std::move(*frame), world_})) ++keyframes_too_late_;
  }
  drop_warner_.Check(Drops());
}

void PoseGraphNode::Restart(const std_msgs::Bool& message) {
  if (message.data) NoteNewWorld("the estimator restarted");
}

void PoseGraphNode::NoteNewWorld(const std::string& reason) {
  ROS_WARN("new world frame of the odometry: %s", reason.c_str());
  BeginWorld();
}

// Waiting keyframes belong to the previous world, so they are dropped.
void PoseGraphNode::BeginWorld() {
  input_.Clear();
  const std::lock_guard<std::mutex> lock(status_mutex_);
  ++world_;
  status_.fix.reset();
}

std::optional<MapFix> PoseGraphNode::AddOdometry(const OdometryEvent& event) {
  if (estimator_.HasChanged(kOdometry, event.getConnectionHeaderPtr())) {
    NoteNewWorld("odometry comes from another estimator");
  }
  const nav_msgs::Odometry& message = *event.getMessage();
  odometry_stream_.Add(ToNanoseconds(message.header.stamp));
  if (!input_.Accepts(message)) {
    drop_warner_.Check(Drops());
    return std::nullopt;
  }
  const std::lock_guard<std::mutex> lock(status_mutex_);
  return status_.fix;
}

bool PoseGraphNode::SaveMapFile(Trigger::Request&, Trigger::Response& response) {
  const std::lock_guard<std::mutex> lock(loops_mutex_);
  const int keyframes = loops_->map().CountKept();
  if (keyframes == 0) {
    response.message = "there is no keyframe to save yet; " + map_file_ + " is unchanged";
    return true;
  }
  try {
    std::filesystem::create_directories(std::filesystem::path(map_file_).parent_path());
    SaveMap(map_file_, loops_->map());
    response.success = true;
    response.message = std::to_string(keyframes) + " keyframes saved to " + map_file_;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool PoseGraphNode::LoadMapFile(Trigger::Request&, Trigger::Response& response) {
  try {
    StartWith(LoadMap(map_file_));
    response.success = true;
    response.message = "starting in the map " + map_file_;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool PoseGraphNode::Reset(Trigger::Request&, Trigger::Response& response) {
  StartWith(KeyframeMap());
  response.success = true;
  response.message = "starting an empty map";
  return true;
}

// Begins a new odometry world: waiting keyframes belong to the previous map.
void PoseGraphNode::StartWith(KeyframeMap map) {
  {
    const std::lock_guard<std::mutex> lock(input_mutex_);
    BeginWorld();
  }
  const std::lock_guard<std::mutex> lock(loops_mutex_);
  auto loops = std::make_unique<LoopCloser>(cameras_);
  loops->SetMap(std::move(map));
  loops_ = std::move(loops);
  images_ = KeyframeImages();
  PublishMap();
  const std::lock_guard<std::mutex> status_lock(status_mutex_);
  map_world_ = world_;
  status_ = Status();
  status_.keyframes = loops_->map().CountKept();
}

void PoseGraphNode::Work() {
  while (auto keyframe = queue_.Pop()) {
    errors_.Run([&] {
      const std::lock_guard<std::mutex> lock(loops_mutex_);
      if (keyframe->world >= map_world_) AddToMap(&*keyframe);
    });
  }
}

void PoseGraphNode::AddToMap(WaitingKeyframe* keyframe) {
  const Stopwatch stopwatch;
  OdometryFrame& frame = keyframe->frame;
  frame.restarted = keyframe->world > map_world_;
  map_world_ = keyframe->world;
  const LoopClosure closure = loops_->Add(frame);
  UpdateStatus(closure, keyframe->world, stopwatch.Milliseconds());
  if (!closure.is_keyframe) return;
  PublishMap();
  PublishMatch(frame, closure);
  Remember(frame);
}

// Ignores the fix if a newer world has begun meanwhile.
void PoseGraphNode::UpdateStatus(const LoopClosure& closure, int world, double milliseconds) {
  const std::lock_guard<std::mutex> lock(status_mutex_);
  if (world == world_) status_.fix = closure.fix;
  status_.keyframes = loops_->map().CountKept();
  if (closure.is_keyframe) status_.keyframe_ms = milliseconds;
  status_.loops.Add(closure);
}

nav_msgs::Path PoseGraphNode::Path() const {
  return ToPath(loops_->map(), config_.output.map_frame, config_.output.world_frame);
}

visualization_msgs::MarkerArray PoseGraphNode::Graph() const {
  return ToGraphMarkers(loops_->map(), config_.output.map_frame);
}

void PoseGraphNode::PublishMap() {
  PublishIfWanted(path_publisher_, [this] { return Path(); });
  PublishIfWanted(graph_publisher_, [this] { return Graph(); });
}

void PoseGraphNode::PublishMatch(const OdometryFrame& frame, const LoopClosure& closure) {
  if (!closure.place || match_publisher_.getNumSubscribers() == 0) return;
  const LoopObservations& seen = closure.place->observations;
  const cv::Mat picture =
      DrawLoop(cameras_, seen, images_.Find({closure.place->earlier, seen.earlier_camera}),
               frame.images.at(seen.later_camera).gray);
  match_publisher_.publish(ToMessage(picture, frame.t_ns, config_.output.camera_frame));
}

// The newest keyframe is that of the frame; thinning may have removed others. Images are stored
// only after the first subscription of ~match_image, and then always, since displays reconnect.
void PoseGraphNode::Remember(const OdometryFrame& frame) {
  shows_matches_ = shows_matches_ || match_publisher_.getNumSubscribers() > 0;
  if (!shows_matches_) return;
  const PoseGraph& graph = loops_->map().graph;
  for (const auto& [camera, image] : frame.images) {
    images_.Add({graph.size() - 1, camera}, image.gray);
  }
  images_.Keep([&](int keyframe) { return graph.Has(keyframe); });
}

DropCounts PoseGraphNode::Drops() const {
  DropCounts drops = {errors_.count()};
  for (const auto& images : image_subscriptions_) drops.push_back(images->unreadable());
  Append(input_.Drops(), &drops);
  drops.push_back({"keyframes_too_late", keyframes_too_late_, ""});
  return drops;
}

void PoseGraphNode::ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::scoped_lock lock(input_mutex_, status_mutex_);
  ReportState(&status);
  status.add("keyframes", status_.keyframes);
  status.add("loops", status_.loops.accepted);
  status.add("dropped", status_.loops.dropped);
  status.add("worlds", world_);
  for (const auto& [gate, count] : status_.loops.refused) {
    status.add(std::string("refused_") + ToString(gate), count);
  }
  status.add("keyframe_ms", status_.keyframe_ms);
  status.add("waiting_keyframes", queue_.size());
  for (const auto& images : image_subscriptions_) images->stream().Report(&status);
  for (StreamMonitor* stream : {&keyframe_stream_, &odometry_stream_}) stream->Report(&status);
  for (const DropCount& drop : Drops()) status.add(drop.cause, drop.count);
}

void PoseGraphNode::ReportState(diagnostic_updater::DiagnosticStatusWrapper* status) {
  using diagnostic_msgs::DiagnosticStatus;
  const double late = keyframe_stream_.Silence() + kMaxLag;
  ImageSubscription& images = *image_subscriptions_.front();
  if (images.SilenceOfImages() > late) {
    const bool silent = images.stream().Silence() > late;
    status->summary(DiagnosticStatus::WARN,
                    std::string("keyframes without images: ") +
                        (silent ? "no images on " : "no usable images on ") + images.topic());
  } else if (odometry_stream_.Silence() > StreamMonitor::kSilence) {
    status->summary(
        DiagnosticStatus::WARN,
        "waiting: no poses on " + node_.resolveName(std::string(kEstimator) + "odometry"));
  } else if (status_.fix) {
    status->summary(DiagnosticStatus::OK, "located in the map");
  } else if (status_.keyframes == 0) {
    status->summary(DiagnosticStatus::OK, "waiting: no keyframe yet");
  } else {
    status->summary(DiagnosticStatus::WARN, "not located in the map yet");
  }
}

std::shared_ptr<void> MakePoseGraphNode(const Config& config, const ros::NodeHandle& node,
                                        const ros::NodeHandle& private_node) {
  if (!IsNeeded(config.pose_graph.loop_closure, "loop_closure", config)) return nullptr;
  return std::make_shared<PoseGraphNode>(config, node, private_node);
}

}  // namespace plm_vins
