// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "common/ros/msg_conversion.h"
#include "offline/ros/bag_message_source.h"

namespace plm_vins {
namespace {

class IndexedBag : public BagMessageSource {
 public:
  explicit IndexedBag(const std::string& file) : file_(file), bag_(file, rosbag::bagmode::Read) {}

  std::map<std::string, std::string> topics() const override {
    std::map<std::string, std::string> types;
    rosbag::View all(bag_);
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      types[connection->topic] = connection->datatype;
    }
    return types;
  }

  void Select(const std::set<std::string>& topics) override {
    const std::vector<std::string> list(topics.begin(), topics.end());
    view_ = std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(list));
    next_ = view_->begin();
  }

  std::optional<BagMessage> Next() override {
    if (damaged_ || next_ == view_->end()) return std::nullopt;
    try {
      BagMessage message{next_->getTopic(), std::vector<uint8_t>(next_->size())};
      ros::serialization::OStream stream(message.data.data(), message.data.size());
      next_->write(stream);
      ++next_;
      return message;
    } catch (const rosbag::BagException& error) {
      damaged_ = true;
      problem_ = file_ + ": read up to a damaged part: " + error.what();
      return std::nullopt;
    }
  }

  std::optional<int64_t> end_ns() const override {
    if (view_->size() == 0) return std::nullopt;
    return ToNanoseconds(view_->getEndTime());
  }

  DropCounts problems() const override { return {{"bag_damaged", damaged_ ? 1 : 0, problem_}}; }

 private:
  std::string file_;
  rosbag::Bag bag_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
  bool damaged_ = false;
  std::string problem_;
};

}  // namespace

std::unique_ptr<BagMessageSource> OpenIndexedBag(const std::string& file) {
  return std::make_unique<IndexedBag>(file);
}

}  // namespace plm_vins
