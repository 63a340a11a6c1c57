// Uses of the made-up option of rholm/reconstruct.h (CMakeLists.txt) that no command shows.
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "base/check_fields.h"
#include "base/field_bytes.h"
#include "base/field_text.h"
#include "rholm/error.h"
#include "rholm/reconstruct.h"

namespace rholm {
namespace {

TEST(OneOption, is_in_messages_between_ranks) {
  ByteWriter writer;
  write_fields(ReconstructOptions{.made_up = 0.25}, writer);
  const std::string bytes = writer.take();
  ByteReader message(bytes);
  ReconstructOptions received;
  read_fields(message, received);
  EXPECT_EQ(received.made_up, 0.25);
}

TEST(OneOption, is_remembered_by_a_folder_to_resume_from) {
  EXPECT_NE(text_of_fields(ReconstructOptions{}).find("made_up 0.5"), std::string::npos);
  EXPECT_NE(text_of_fields(ReconstructOptions{.made_up = 0.25}),
            text_of_fields(ReconstructOptions{}));
}

TEST(OneOption, is_checked_against_its_bounds) {
  EXPECT_NO_THROW(check_fields(ReconstructOptions{.made_up = 1}));
  EXPECT_THROW(check_fields(ReconstructOptions{.made_up = 1.5}), Error);
}

}  // namespace
}  // namespace rholm
