// The reference part of docs/scene-language.md, made from the same lists as the functions themselves.
#pragma once
#include <string>

#include "sdf/base/result.h"

namespace sdf {

/// Markdown: every function of the scene language with its arguments, defaults and meaning.
std::string sceneReference();

/// The page with the text between its two reference markers replaced by sceneReference(); an error where it
/// lacks the markers.
Result<std::string> withSceneReference(const std::string& page);

}  // namespace sdf
