-- A 
ambient(0.2)
shadows { kind = "sof.", sharpness = 10 }
ambient_occlusion { kind = "taps" }
background({0.2, 0.22, 0.25})
