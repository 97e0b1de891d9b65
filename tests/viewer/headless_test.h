// What tests of OpenGL begin with.
#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "viewer/gpu/context.h"

namespace sdf::viewer {

/// A context for each test.
class HeadlessTest : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = Context::headless();
    ASSERT_TRUE(opened) << opened.error().message;
    context = std::move(*opened);
  }
  std::unique_ptr<Context> context;
};

}  // namespace sdf::viewer
