-- Measuring shape S4: ž gyroid sheet as a plain formula,max in a ball.
return field(function(x, y, z)
  local g = sin(5 * x) * cos(6 * y) + sin(5 *x)
  return max(abs(g) / 8 - 0.15, length({x, y, z}) - 1.5)
end)
