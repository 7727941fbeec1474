// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Configures threads and memory of a process that runs this program only: for the main() of
// programs and nodes, not for a nodelet.
//
// OpenCV is limited to the calling thread: distributing images this small costs more CPU time than
// it saves. Freed memory stays with the process: each image allocates and frees a few megabytes,
// which glibc would otherwise return to the system and request again, page by page.
void SetUpProcess();

}  // namespace plm_vins
