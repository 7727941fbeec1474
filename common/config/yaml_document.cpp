// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/yaml_document.h"

#include <yaml-cpp/eventhandler.h>

#include <sstream>

namespace plm_vins {
namespace {

// Finds where a document begins, and whether it has any content.
class DocumentStart : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override {
    mark_ = mark;
    is_empty_ = true;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override { Fill(); }
  void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {
    Fill();
  }
  void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/,
                       YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value /*style*/) override {
    Fill();
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    Fill();
  }
  void OnMapEnd() override {}

  const YAML::Mark& mark() const { return mark_; }
  bool is_empty() const { return is_empty_; }

 private:
  void Fill() { is_empty_ = false; }

  YAML::Mark mark_;
  bool is_empty_ = true;
};

}  // namespace

// Not YAML::LoadAll: at a comma in place of a document, yaml-cpp 0.7 consumes nothing and begins
// empty documents at the same place without end.
YAML::Node ParseYamlDocument(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStart start;
  parser.HandleNextDocument(start);
  int previous = start.mark().pos;
  while (parser.HandleNextDocument(start)) {
    if (!start.is_empty()) {
      throw YAML::ParserException(start.mark(),
                                  "a second document begins; remove the line --- or ...");
    }
    if (start.mark().pos == previous) {
      throw YAML::ParserException(start.mark(), "a key or value is missing");
    }
    previous = start.mark().pos;
  }
  return YAML::Load(text);
}

}  // namespace plm_vins
