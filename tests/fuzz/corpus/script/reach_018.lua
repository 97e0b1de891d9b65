return cylinder(0.5, 1), infinite_cylinder(0.2), cone(1, 1), capped_cone(1, 0.5, 1), round_cone(5.6, 0.3, 1),
  hex_prism(1, 0.5), tri_prism(1, 0.5), gyroid(1, 0.1), schwarz_p(1, 0.1), schwacrz_d(1, 0.1)
