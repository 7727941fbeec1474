// SPDX-License-Identifier: BSD-3-Clause
// Shared code of the front-end benchmarks: arguments CONFIG IMAGE_FOLDER, one thread.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/process_setup.h"

namespace plm_vins {

// Returns the first images of a folder in the order of their names, CV_8UC1.
inline std::vector<cv::Mat> ReadImages(const std::string& folder, size_t max_images) {
  std::vector<cv::String> files;
  cv::glob(folder + "/*.png", files);
  files.resize(std::min(files.size(), max_images));
  std::vector<cv::Mat> images;
  for (const cv::String& file : files) images.push_back(cv::imread(file, cv::IMREAD_GRAYSCALE));
  if (images.size() < 2) throw std::invalid_argument("fewer than two images in " + folder);
  return images;
}

// The main function of program `name`: reads the input, registers the benchmarks on it and runs
// them.
template <typename Input>
int RunImageBenchmark(int argc, char** argv, const std::string& name,
                      Input (*read)(const std::string& config_file, const std::string& folder),
                      void (*register_benchmarks)(const Input&)) {
  benchmark::Initialize(&argc, argv);
  if (argc != 3) {
    std::cerr << "usage: " << name << " CONFIG IMAGE_FOLDER [--benchmark_...]\n";
    return 1;
  }
  SetUpProcess();
  try {
    const Input input = read(argv[1], argv[2]);
    register_benchmarks(input);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace plm_vins
