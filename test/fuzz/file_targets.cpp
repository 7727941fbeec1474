// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "common/config/config.h"
#include "offline/recordings/asl_recording.h"
#include "test/fuzz/fuzz_folder.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

namespace fs = std::filesystem;

std::string ImuCsv() {
  std::string text = "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
  for (int i = 0; i < 40; ++i) {
    text += std::to_string(1403636579758555392 + 5'000'000 * i) + ",0.1,-0.2,0.03,8.1,-0.4,5e-1\n";
  }
  return text;
}

std::string ImagesCsv() {
  std::string text = "#timestamp [ns],filename\n";
  for (int i = 0; i < 4; ++i) {
    const std::string stamp = std::to_string(1403636579758555392 + 50'000'000 * i);
    text.append(stamp).append(",").append(stamp).append(".png\n");
  }
  return text;
}

}  // namespace

Target ConfigTarget() {
  std::vector<Bytes> seeds;
  for (const auto& entry : fs::directory_iterator(CONFIG_DIR)) {
    if (entry.path().extension() == ".yaml") seeds.push_back(ReadFile(entry.path()));
  }
  std::sort(seeds.begin(), seeds.end());  // directory order is arbitrary
  return {"config", seeds, [](const Bytes& bytes) {
            const fs::path file = Folder() / "config.yaml";
            Write(file, ToText(bytes));
            EffectiveValues(LoadConfig(file.string()));
          }};
}

// An input consists of both tables, with a zero byte in between.
Target AslTarget() {
  const std::string seed = ImuCsv() + std::string(1, '\0') + ImagesCsv();
  return {"asl", {ToBytes(seed)}, [](const Bytes& bytes) {
            const std::string text = ToText(bytes);
            const size_t end = text.find('\0');
            Write(Folder() / "asl" / "imu0" / "data.csv", text.substr(0, end));
            Write(Folder() / "asl" / "cam0" / "data.csv",
                  end == std::string::npos ? "" : text.substr(end + 1));
            const auto recording = OpenAslFolder((Folder() / "asl").string());
            while (const auto event = recording->Next()) {
              if (event->kind == RecordingEvent::Kind::kImage) recording->LoadImage();
            }
          }};
}

}  // namespace plm_vins::fuzz
