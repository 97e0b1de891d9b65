local s = capsule{radius = 1.2}
part("a", s:translate(1, 0, 0):rotate(10, 20, 30)) part("b", s:rotate_about({0, 1, 0}, 45)) part("c", s:scale(2)) part("d", s:scale(1, -2, 3))
part("e", s:translate(1, 0, 0):mirror("x")) part("f", s:mirror{normal = {0, 1, 0}})
part("g", s:repeat_grid{cell = {2, 0, 2}, count = {3, 1, 3}}) part("h", s:repeat_grid{cell = {2, 2, 2}} & box(3, 3, 3))
part("i", s:translate(2, 0, 0):polar_Repeat(7))
