// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/ground_truth.h"

#include "common/io/output_file.h"
#include "simulator/recording/csv_row.h"
#include "vins_estimator/output/pose_rows.h"

namespace plm_vins::simulator {

void WriteTum(const std::string& path, const std::vector<FrameState>& states) {
  OutputFile file(path);
  for (const FrameState& state : states) {
    file.stream() << FormatTumRow(state.t_ns, state.T_W_B());
  }
  file.Close();
}

void WriteEurocCsv(const std::string& path, const std::vector<FrameState>& states) {
  OutputFile file(path);
  file.stream()
      << "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
         "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad "
         "s^-1], "
         "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], "
         "b_a_RS_S_z [m s^-2]\n";
  for (const FrameState& state : states) {
    const auto p = state.position(), v = state.velocity();
    const auto gyro = state.gyro_bias(), accel = state.accel_bias();
    const auto q = state.rotation();
    file.stream() << CsvRow(
        state.t_ns, {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(), gyro.x(),
                     gyro.y(), gyro.z(), accel.x(), accel.y(), accel.z()});
  }
  file.Close();
}

}  // namespace plm_vins::simulator
