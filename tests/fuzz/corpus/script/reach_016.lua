-- Measuring shape in a ball.
return field(function(x, y, z)
  local g = sin( 0* x) * cos(5 * y) + sin(5 * y) *tetrahedron + sin(5 * z) * cos(5 * x)
  return max(abs(polar_repeatg))
end)
