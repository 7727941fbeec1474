// SPDX-License-Identifier: BSD-3-Clause
#include "common/io/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace plm_vins {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CommandLineTest : public ::testing::Test {
 protected:
  CommandLineTest() : command_line_("A program") {
    command_line_.Add("path", TakePath(&path_), "a path");
    command_line_.Add("number", TakeNumber(-2, 10, &number_), "a number");
    command_line_.AddList("list", TakeListItem(), "several texts");
    command_line_.AddFlag("flag", &flag_, "a flag");
  }

  bool Parse(std::vector<const char*> words) {
    words.insert(words.begin(), "program");
    return command_line_.Parse(static_cast<int>(words.size()), words.data());
  }

  void ExpectError(const std::string& message, const std::vector<const char*>& words) {
    try {
      Parse(words);
      ADD_FAILURE() << message;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    } catch (const std::exception& error) {  // of boost
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  }

  std::string path_;
  double number_ = 0;
  std::vector<std::string> list_;
  bool flag_ = true;

 private:
  TakeValue TakeListItem() {
    return [this](const std::string& text) -> std::string {
      list_.push_back(text);
      return text == "bad" ? "expected good" : "";
    };
  }

  CommandLine command_line_;
};

TEST_F(CommandLineTest, TakesValues) {
  EXPECT_TRUE(Parse({"--path", "-x y", "--number=-1.5", "--flag"}));
  EXPECT_EQ(path_, "-x y");
  EXPECT_EQ(number_, -1.5);
  EXPECT_TRUE(flag_);
  EXPECT_TRUE(Parse({"--number", "-1"}));
  EXPECT_EQ(number_, -1);
  EXPECT_FALSE(flag_);
}

TEST_F(CommandLineTest, TakesListsUpToTheNextOption) {
  EXPECT_TRUE(Parse({"--list", "a=-1", "-2", "--number", "3", "--list", "c"}));
  EXPECT_THAT(list_, ElementsAre("a=-1", "-2", "c"));
}

TEST_F(CommandLineTest, NamesTheOptionThatIsWrong) {
  ExpectError("--path: expected a path, but it is empty", {"--path", ""});
  for (const char* text : {"nan", "11", "three", "", "1x"}) {
    ExpectError(std::string("--number: expected -2 to 10 instead of ") + text, {"--number", text});
  }
  ExpectError("--list: expected good", {"--list", "good", "bad"});
  ExpectError("--number: expected -2 to 10 instead of --flag", {"--number", "--flag"});
  ExpectError("'--path' cannot be specified more than once", {"--path", "a", "--path", "b"});
  ExpectError("unrecognised option '--numb'", {"--numb", "1"});
  ExpectError("positional", {"word"});
}

TEST_F(CommandLineTest, PrintsHelp) {
  ::testing::internal::CaptureStdout();
  EXPECT_FALSE(Parse({"--help", "--number", "11"}));
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), HasSubstr("several texts"));
}

}  // namespace
}  // namespace plm_vins
