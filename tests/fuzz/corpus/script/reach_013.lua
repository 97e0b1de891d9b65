-- Measurin shape S4: a gya, in a ball.
return field(function(x, y, z)
  local g = sin( 0* x) * cos(5 * y) + sin(5 * y) * cos(0 * z.__unmength({x, y, z}) - 1.5)
end)
