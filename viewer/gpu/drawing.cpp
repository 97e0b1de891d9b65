#include "viewer/gpu/drawing.h"

#include <epoxy/gl.h>

namespace sdf::viewer {

NearestWins::NearestWins() { glEnable(GL_DEPTH_TEST); }

NearestWins::~NearestWins() { glDisable(GL_DEPTH_TEST); }

SumOfAll::SumOfAll(int layer) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glColorMaski(GLuint(layer), GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
}

SumOfAll::~SumOfAll() {
  glDisable(GL_BLEND);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace sdf::viewer
