// Short ways to run scene text in tests.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "sdf/script/script.h"

namespace sdf {

/// The scene, or a test failure and an empty scene.
inline Scene sceneOf(const std::string& text, const ScriptOptions& options = {}) {
  Result<Scene> scene = runScene(text, "scene.lua", options);
  if (scene) return std::move(scene).value();
  ADD_FAILURE() << scene.error().message << "\nin\n" << text;
  return {};
}

/// The message of the error that the text must cause.
inline std::string errorOf(const std::string& text, const ScriptOptions& options = {}) {
  const Result<Scene> scene = runScene(text, "scene.lua", options);
  if (!scene) {
    EXPECT_EQ(scene.error().kind, ErrorKind::Scene);
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << "one line";
    return scene.error().message;
  }
  ADD_FAILURE() << "no error from\n" << text;
  return {};
}

/// A number that the script computes: `expression` may use what `before` defines.
inline double numberOf(const std::string& expression, const std::string& before = "",
                       const ScriptOptions& options = {}) {
  const Scene scene = sceneOf(before + "\nambient(" + expression + ") return sphere(1)", options);
  return uniformValue(scene.ambient.x);
}

/// The value of an expression at a point.
inline double at(const Expr& e, double x, double y, double z) {
  return uniformValue(remap(e, {Expr(x), Expr(y), Expr(z)}, 1.0));
}

}  // namespace sdf
