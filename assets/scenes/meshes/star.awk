# Writes star.obj, a flat star with a hole in the plane y = 0, the mouth of an emitter that pours down, in meters:
# awk -f star.awk > star.obj. Its triangles are counterclockwise seen from below.
BEGIN {
  pi = atan2(0, -1);
  corners = 10; outer = 0.10; inner = 0.045; hole = 0.35;
  print "# Made by star.awk";
  print "o star";
  for (k = 0; k < corners; ++k) {
    r = k % 2 ? inner : outer; a = 2 * pi * k / corners;
    printf "v %.6f 0 %.6f\nv %.6f 0 %.6f\n", hole * r * cos(a), hole * r * sin(a), r * cos(a), r * sin(a);
  }
  for (k = 0; k < corners; ++k) {
    n = (k + 1) % corners;
    print "f", 2 * k + 1, 2 * k + 2, 2 * n + 2;
    print "f", 2 * k + 1, 2 * n + 2, 2 * n + 1;
  }
}
