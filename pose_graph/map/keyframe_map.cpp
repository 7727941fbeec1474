// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

void KeyframeMap::Remove(int keyframe, int anchor) {
  graph.Remove(keyframe, anchor);
  Keyframe& removed = keyframes[keyframe];
  removed.corners = std::vector<DescribedCorner>();  // frees the memory, which `= {}` would keep
  removed.segments = std::vector<TrackedSegment>();
}

int KeyframeMap::CountKept() const { return static_cast<int>(graph.Kept().size()); }

std::vector<int> KeyframeMap::NumbersInMap() const {
  const std::vector<bool> connected = graph.ConnectedWith(0);
  std::vector<int> numbers;
  for (const int i : graph.Kept()) {
    if (connected[i]) numbers.push_back(i);
  }
  return numbers;
}

KeyframeMap KeyframeMap::Compact() const {
  KeyframeMap compact;
  std::vector<int> new_number(keyframes.size(), -1);
  for (const int i : graph.Kept()) {
    new_number[i] = compact.graph.AddNode(graph.node(i));
    compact.keyframes.push_back(keyframes[i]);
  }
  for (LevelEdge edge : graph.edges()) {
    edge.from = new_number[edge.from];
    edge.to = new_number[edge.to];
    compact.graph.AddEdge(edge);
  }
  return compact;
}

}  // namespace plm_vins
