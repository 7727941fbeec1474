// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/merging/line_structure.h"

#include "vins_estimator/manhattan/line_directions.h"
#include "vins_estimator/merging/line_merging.h"
#include "vins_estimator/recall/anchor_policy.h"
#include "vins_estimator/recall/line_recognition.h"

namespace plm_vins {

void LineStructure::FindAxes(LocalMap* map) {
  const auto directions = LineDirections(map->window, map->lines, same_line_.noise);
  manhattan_.Update(map->window.newest().state.t_ns, directions);
  NameAxes(manhattan_, directions, &map->lines);
}

UnitedLines LineStructure::Unite(LocalMap* map) {
  const Eigen::Quaterniond R_M_W =
      manhattan_.R_W_M().value_or(Eigen::Quaterniond::Identity()).conjugate();
  const MergedLines merged = MergeLines(same_line_, R_M_W, map);
  const std::vector<int64_t> recognized = RecognizeLines(same_line_, R_M_W, map);
  map->ForgetIdleAliases();
  for (const int64_t id : merged.absorbed) manhattan_.Remove(id);
  for (const int64_t id : recognized) manhattan_.Remove(id);
  NoteUse(map->lines, &map->window);
  return {merged.counts, static_cast<int>(recognized.size()), merged.absorbed};
}

}  // namespace plm_vins
