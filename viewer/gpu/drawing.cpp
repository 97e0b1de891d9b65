#include "viewer/gpu/drawing.h"

#include <epoxy/gl.h>

namespace sdf::viewer {

NearestWins::NearestWins() { glEnable(GL_DEPTH_TEST); }

NearestWins::~NearestWins() { glDisable(GL_DEPTH_TEST); }

SumOfAll::SumOfAll() {
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(GL_FUNC_ADD);
}

SumOfAll::~SumOfAll() { glDisable(GL_BLEND); }

OneLayer::OneLayer(int layer) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glColorMaski(GLuint(layer), GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

OneLayer::~OneLayer() { glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); }

}  // namespace sdf::viewer
