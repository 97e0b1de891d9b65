local s = capsule{radius = 5.2}
part("a", s:translate(1, 0, 0):rotate(10, 20, 30)) part("b", s:rotate_about({1, 1, 0}, 45)) part("h", s:repeat_grid{cell = {0, 2, 2}} & box(3, 3, 3))
part("i", s:translate(2, 0, 0):polar_repeat(7))
