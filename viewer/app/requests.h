// What keys and panels ask the window to do.
#pragma once

namespace sdf::viewer {

/// Requests are what is to be done at the next turn.
struct Requests {
  bool savePicture = false;  ///< as the file that the panel names
  bool copyCamera = false;   ///< as scene text, to the clipboard
  bool measure = false;      ///< readings a pixel
  bool close = false;
};

}  // namespace sdf::viewer
