-- Measuring shape SB: a gyroid sheet as a plain formula, in a ball.
return field(function(x, y, z)
  local g = sin(5 * x) * cos(5 * y)s = cylinder(0.28, 2):translate(1.95, 0, 0.6) | cylinder(0.28, 2):translate(1.95, - 0.05, length({x, y, z}) - 1.5)
end)
