#include "base/plain_text.h"

#include <gtest/gtest.h>

namespace rholm {
namespace {

using namespace std::string_literals;

TEST(plain_text, characters_are_read_as_utf8_says) {
  EXPECT_EQ(first_character("a").code, U'a');
  EXPECT_EQ(first_character("\xc3\xa4").code, U'\u00e4');
  EXPECT_EQ(first_character("\xe2\x82\xac rest").code, U'\u20ac');
  EXPECT_EQ(first_character("\xf0\x9f\x90\x87").code, U'\U0001f407');
  EXPECT_EQ(first_character("\xf4\x8f\xbf\xbf").bytes.size(), 4u);  // the last code point
  // Invalid: a single continuation byte, a cut sequence, too long a form, half a surrogate pair,
  // and values beyond the last code point.
  for (const std::string& wrong :
       {"\x80"s, "\xff"s, "\xc3"s, "\xe2\x82"s, "\xc3("s, "\xc0\xaf"s, "\xe0\x80\xaf"s,
        "\xf0\x80\x80\xaf"s, "\xed\xa0\x80"s, "\xf4\x90\x80\x80"s, "\xf8\x88\x80\x80\x80"s}) {
    EXPECT_TRUE(first_character(wrong).bytes.empty()) << escaped_line(wrong);
  }
}

TEST(plain_text, what_commands_a_terminal_is_escaped) {
  EXPECT_EQ(escaped_text("a b\n\tc"), "a b\n\tc");
  EXPECT_EQ(escaped_line("a b\n\tc"), "a b\\n\tc");
  EXPECT_EQ(escaped_text("\x1b[31m\r\x07\x7f"), "\\x1b[31m\\x0d\\x07\\x7f");
  EXPECT_EQ(escaped_text("x\0y"s), "x\\x00y");
  EXPECT_EQ(escaped_text("\xc2\x9b"
                         "31m"),
            "\\u009b31m");  // control character C1
  EXPECT_EQ(escaped_text("\x9b"
                         "31m"),
            "\\x9b31m");  // the same character in Latin 1
  // The mark for right to left is built from numbers: clang-tidy reports it in a literal.
  const std::string turned{static_cast<char>(0xe2), static_cast<char>(0x80),
                           static_cast<char>(0xae)};
  EXPECT_EQ(escaped_text(turned + "fdp"), "\\u202efdp");
  EXPECT_EQ(escaped_text("\xc3\xa4\xe6\xbc\xa2\xf0\x9f\x90\x87"),
            "\xc3\xa4\xe6\xbc\xa2\xf0\x9f\x90\x87");
}

TEST(plain_text, words_of_shells) {
  EXPECT_EQ(shell_text("a-b_c.ply"), "a-b_c.ply");
  EXPECT_EQ(shell_text(""), "''");
  EXPECT_EQ(shell_text("a b"), "'a b'");
  EXPECT_EQ(shell_text("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_text("~"), "'~'");
  EXPECT_EQ(shell_text("\xc3\xa4"), "'\xc3\xa4'");
  EXPECT_EQ(shell_text("a\nb'\\\x1b"
                       "7"),
            "$'a\\012b\\'\\\\\\0337'");
  EXPECT_EQ(shell_text("\xc2\x9b"), "$'\\302\\233'");
}

TEST(plain_text, names_of_files_are_no_options) {
  EXPECT_EQ(shell_text("-x"), "-x");
  EXPECT_EQ(shell_word("-x.ply"), "./-x.ply");
  EXPECT_EQ(shell_word("-x y"), "'./-x y'");
  EXPECT_EQ(shell_word("a/-x"), "a/-x");
  EXPECT_EQ(shell_word("-"), "-");
}

TEST(plain_text, lists_have_their_last_word_before_the_last_entry) {
  EXPECT_EQ(listed({}, "or"), "");
  EXPECT_EQ(listed({"a"}, "or"), "a");
  EXPECT_EQ(listed({"a", "b"}, "or"), "a or b");
  EXPECT_EQ(listed({"a", "b", "c"}, "and"), "a, b and c");
}

TEST(plain_text, shows_only_what_a_terminal_can_bear) {
  EXPECT_EQ(in_quotes("word"), "'word'");
  EXPECT_EQ(in_quotes("\x1b[31m\n"), "'?[31m?'");
  std::string expected(40, 'x');
  expected.insert(0, 1, '\'');
  EXPECT_EQ(in_quotes(std::string(100, 'x')), expected + "...'");
}

}  // namespace
}  // namespace rholm
