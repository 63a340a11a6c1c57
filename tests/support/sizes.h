// Tests of two sizes, of one body: NAME, which runs each time, and NAME_nightly.
#pragma once

#include <gtest/gtest.h>

// The body knows which one it is: `nightly`.
#define TEST_OF_TWO_SIZES(suite, name)                  \
  void suite##_##name(bool nightly);                    \
  TEST(suite, name) { suite##_##name(false); }          \
  TEST(suite, name##_nightly) { suite##_##name(true); } \
  void suite##_##name(bool nightly)
