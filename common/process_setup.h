// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// How threads and memory are used by a process that runs nothing but this: for the main() of
// programs and nodes, not for a nodelet.
//
// OpenCV gets no threads besides the one that calls it: to share out work on images this small
// costs more of the processor than it saves time. And memory that is freed stays with the process:
// each image takes and frees a few megabytes, which the C library of Linux otherwise gives back to
// the system and fetches again, page by page.
void SetUpProcess();

}  // namespace plm_vins
