// SPDX-License-Identifier: BSD-3-Clause
// Configuration files in the style of VINS-Mono and PL-VINS, with their keys.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace plm_vins {

// Returns the file with one text replaced.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  return text.replace(position, from.size(), to);
}

inline constexpr const char* kVinsMonoFile = R"(%YAML:1.0

#common parameters
imu_topic: "/imu0"
image_topic: "/cam0/image_raw"
output_path: "/home/somebody/output/"

model_type: PINHOLE
camera_name: camera
image_width: 752
image_height: 480
distortion_parameters:
   k1: -2.917e-01
   k2: 8.228e-02
   p1: 5.333e-05
   p2: -1.578e-04
projection_parameters:
   fx: 4.616e+02
   fy: 4.603e+02
   cx: 3.630e+02
   cy: 2.481e+02

estimate_extrinsic: 1   # 0: fixed, 1: refine, 2: find
extrinsicRotation: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [0.0148655429818, -0.999880929698, 0.00414029679422,
           0.999557249008, 0.0149672133247, 0.025715529948, 
           -0.0257744366974, 0.00375618835797, 0.999660727178]
extrinsicTranslation: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [-0.0216401454975,-0.064676986768, 0.00981073058949]

max_cnt: 150            # corners
min_dist: 30            
freq: 10                
F_threshold: 1.0        
show_track: 1           
equalize: 1             
fisheye: 0              

max_solver_time: 0.04  
max_num_iterations: 8   
keyframe_parallax: 10.0 

acc_n: 0.08          #0.2   0.04
gyr_n: 0.004         
acc_w: 0.00004       
gyr_w: 2.0e-6        
g_norm: 9.81007      

loop_closure: 1                    
load_previous_pose_graph: 0        
fast_relocalization: 0             
pose_graph_save_path: "/home/somebody/output/pose_graph/" 

estimate_td: 1                      
td: 0.005                             # image clock + td: IMU clock

rolling_shutter: 0                  
rolling_shutter_tr: 0               

save_image: 1                   
visualize_imu_forward: 0        
visualize_camera_size: 0.4      
)";

// A minimal valid configuration.
inline constexpr const char* kShortFile = R"(%YAML:1.0
image_topic: "/image"
imu_topic: "/imu"
model_type: PINHOLE
image_width: 640
image_height: 480
projection_parameters: {fx: 400, fy: 400, cx: 320, cy: 240}
distortion_parameters: {k1: 0, k2: 0, p1: 0, p2: 0}
estimate_extrinsic: 2
)";

}  // namespace plm_vins
