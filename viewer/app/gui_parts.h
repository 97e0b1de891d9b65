// Panels that edit what a scene consists of. Private to viewer/app; needs a Dear ImGui window begun.
#pragma once
#include "viewer/app/session.h"

namespace sdf::viewer {

/// Each lays out the controls of one kind of thing.
void parameterSliders(Session& session);
void lightPanel(Session& session);
void materialPanel(Session& session);

}  // namespace sdf::viewer
