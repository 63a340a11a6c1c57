#include "cli/options/field_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/field_text.h"
#include "cli/grammar/help.h"
#include "cli/terminal/session.h"
#include "rholm/monte_carlo.h"
#include "support/made_up_options.h"

namespace rholm::cli {
namespace {

using test::Colour;
using test::Outer;

Outer parsed(const std::vector<std::string>& words) {
  Outer values;
  CommonOptions common;
  Command command;
  command.name = "made-up";
  command.options = field_options(values);
  parse(command, words, common);
  return values;
}

TEST(field_options, have_every_field_of_the_program_under_its_name) {
  Outer values;
  std::vector<std::string> names;
  for (const Option& option : field_options(values)) names.push_back(option.typed());
  EXPECT_EQ(names, (std::vector<std::string>{"--size", "--share-of-all", "--count", "--flag",
                                             "--colour", "--place"}));
}

TEST(field_options, say_units_choices_and_defaults) {
  Outer values;
  const auto help = [&](const std::string& name) {
    const std::vector<Option> all = field_options(values);
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Option& o) { return o.name == name; });
    return found == all.end() ? "" : option_heading(*found) + ": " + found->help;
  };
  EXPECT_EQ(help("size"),
            "--size S: how large; a part of the diagonal of the bounding box; 2 by default");
  EXPECT_EQ(help("share-of-all"), "--share-of-all auto|P: how much");
  EXPECT_EQ(help("count"), "--count N: how many; 3 by default");
  EXPECT_EQ(help("flag"), "--flag: whether");
  EXPECT_EQ(help("colour"), "--colour red|green: which; green by default");
}

TEST(field_options, set_the_fields) {
  const Outer values = parsed({"--size", "0.25", "--share-of-all", "0.5", "--count=4", "--flag",
                               "--colour", "red", "--place", "1,2,3"});
  EXPECT_EQ(text_of_fields(values),
            "size 0.25 share_of_all 0.5 count 4 flag true colour red place 1,2,3 inner none");
  EXPECT_EQ(text_of_fields(parsed({"--share-of-all", "auto"})), text_of_fields(Outer{}));
}

TEST(field_options, of_one_field_say_whether_it_was_given) {
  Given<Outer> given;
  CommonOptions common;
  Command command;
  command.name = "made-up";
  command.options = {field_option_of(given, "count", "of a thing: "),
                     field_option_of(given, "colour")};
  EXPECT_EQ(command.options[0].help, "of a thing: how many; 3 by default");
  const std::vector<std::string> words = {"--count", "3"};
  parse(command, words, common);
  EXPECT_TRUE(given.has("count"));
  EXPECT_FALSE(given.has("colour"));
  EXPECT_THROW(field_option_of(given, "height"), std::logic_error);
}

TEST(field_options, that_may_be_missing_take_whole_numbers) {
  MonteCarloOptions values;
  CommonOptions common;
  Command command;
  command.name = "made-up";
  command.options = {field_option_of(values, "samples")};
  const auto parsed_as = [&](const std::string& text) {
    const std::vector<std::string> words = {"--samples", text};
    parse(command, words, common);
    return values.samples;
  };
  EXPECT_EQ(parsed_as("8"), 8U);
  for (const char* wrong : {"1", "8.5", "many", "2000000000"}) {
    EXPECT_THROW(parsed_as(wrong), UsageError) << wrong;
  }
}

TEST(field_options, refuse_what_is_out_of_bounds) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--size", "0"},
                                                {"--size", "1.5"},
                                                {"--share-of-all", "2"},
                                                {"--share-of-all", "much"},
                                                {"--count", "0"},
                                                {"--count", "2.5"},
                                                {"--colour", "blue"},
                                                {"--place", "1,2"},
                                                {"--inner", "1"},
                                                {"--threads", "-1"}}) {
    EXPECT_THROW(parsed(words), UsageError) << words[0] << " " << words[1];
  }
}

TEST(field_option_of, has_the_bounds_of_its_field) {
  Outer values;
  Command command;
  command.options = {field_option_of(values, "count")};
  CommonOptions common;
  const auto take = [&](const std::vector<std::string>& words) { parse(command, words, common); };
  take({"--count", "7"});
  EXPECT_EQ(values.count, 7);
  EXPECT_THROW(take({"--count", "10"}), UsageError);
  EXPECT_THROW(take({"--flag"}), UsageError);
  EXPECT_THROW(field_option_of(values, "counts"), std::logic_error);
}

TEST(scale_lengths, turns_parts_of_the_diagonal_into_lengths) {
  Outer values = parsed({});
  EXPECT_FALSE(has_lengths(values));
  values = parsed({"--size", "0.25", "--share-of-all", "0.5"});
  EXPECT_TRUE(has_lengths(values));
  scale_lengths(values, 8);
  EXPECT_EQ(values.size, 2);
  EXPECT_EQ(*values.share, 0.5);  // a share has no length
}

}  // namespace
}  // namespace rholm::cli
