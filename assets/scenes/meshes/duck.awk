# Writes duck.obj, a toy duck that looks along +x, in meters: awk -f duck.awk > duck.obj
# Its surface is where a signed distance of joined ellipsoids is 0, meshed by one vertex a cell (surface nets, Gibson 1998).
# Triangles are then cut where the color changes.
function min(a, b) { return a < b ? a : b; }
function max(a, b) { return a > b ? a : b; }
function ellipsoid(x, y, z, rx, ry, rz,    level, slope) {
  level = sqrt((x / rx) ^ 2 + (y / ry) ^ 2 + (z / rz) ^ 2);
  slope = sqrt((x / rx ^ 2) ^ 2 + (y / ry ^ 2) ^ 2 + (z / rz ^ 2) ^ 2);
  return slope > 0 ? level * (level - 1) / slope : -min(rx, min(ry, rz));
}
# Union of two whose seam is filled over a width of k.
function join(a, b, k,    h) { h = max(k - (a > b ? a - b : b - a), 0) / k; return min(a, b) - h * h * k / 4; }
# Turned about z by an angle with this cosine and sine.
function turned(x, y, z, c, s, rx, ry, rz) { return ellipsoid(c * x + s * y, c * y - s * x, z, rx, ry, rz); }

function head(x, y, z) { return ellipsoid(x - 0.105, y - 0.235, z, 0.078, 0.073, 0.074); }
function beak(x, y, z) {
  return join(turned(x - 0.176, y - 0.232, z, 0.966, 0.259, 0.060, 0.017, 0.044),
              turned(x - 0.170, y - 0.209, z, 0.999, -0.035, 0.045, 0.014, 0.034), 0.010);
}
function eye(x, y, z) { return ellipsoid(x - 0.143, y - 0.262, z - 0.053, 0.015, 0.017, 0.015); }
function spot(x, y, z) { return ellipsoid(x - 0.150, y - 0.267, z - 0.063, 0.015, 0.015, 0.015); }
function duck(x, y, z,    d) {
  z = z < 0 ? -z : z;
  d = ellipsoid(x, y - 0.095, z, 0.190, 0.100, 0.150);
  d = -join(-d, y - 0.012, 0.04);  # a flat base
  d = join(d, turned(x + 0.160, y - 0.150, z, 0.819, -0.574, 0.095, 0.028, 0.062), 0.06);
  d = join(d, ellipsoid(x - 0.090, y - 0.160, z, 0.070, 0.080, 0.075), 0.05);
  d = join(d, turned(x + 0.045, y - 0.125, z - 0.128, 0.966, -0.259, 0.105, 0.046, 0.032), 0.014);
  d = join(d, head(x, y, z), 0.02);
  d = join(d, beak(x, y, z), 0.008);
  return join(d, eye(x, y, z), 0.004);
}
# Below 0 where the color is another: that of the beak, or that of an eye.
function border(x, y, z) { z = z < 0 ? -z : z; return min(beak(x, y, z) - min(head(x, y, z), 0.005), spot(x, y, z)); }

# The gradient of duck(), or of border(), goes to gx, gy, gz; returns its square.
function slopeOf(which, x, y, z,    e) {
  e = 1e-5;
  gx = (value(which, x + e, y, z) - value(which, x - e, y, z)) / (2 * e);
  gy = (value(which, x, y + e, z) - value(which, x, y - e, z)) / (2 * e);
  gz = (value(which, x, y, z + e) - value(which, x, y, z - e)) / (2 * e);
  return gx * gx + gy * gy + gz * gz;
}
function value(which, x, y, z) { return which ? border(x, y, z) : duck(x, y, z); }
# Moves a vertex to where duck(), or border(), is 0; at most by `reach`.
function settle(v, which, reach,    step) {
  step = value(which, vx[v], vy[v], vz[v]) / max(slopeOf(which, vx[v], vy[v], vz[v]), 1e-3);
  step *= min(1, reach / max(sqrt(step * step * (gx * gx + gy * gy + gz * gz)), 1e-12));
  vx[v] -= step * gx; vy[v] -= step * gy; vz[v] -= step * gz;
}
function triangle(a, b, c,    k, other, cut1, cut2) {
  # Turned so that `a` is alone on its side of the border, if it has two sides.
  for (k = 0; k < 3 && (side[a] == 0 || side[b] == side[a] || side[c] == side[a]); ++k) { other = a; a = b; b = c; c = other; }
  if (k == 3 || side[b] + side[c] == 0) { face(a, b, c); return; }
  if (side[b] == 0) { cut1 = cutOf(a, c); face(a, b, cut1); face(b, c, cut1); return; }
  if (side[c] == 0) { cut1 = cutOf(a, b); face(a, cut1, c); face(cut1, b, c); return; }
  cut1 = cutOf(a, b); cut2 = cutOf(a, c);
  face(a, cut1, cut2); face(cut1, b, c); face(cut1, c, cut2);
}
function cutOf(a, b,    key, t) {
  key = min(a, b) " " max(a, b);
  if (!(key in cuts)) {
    t = level[a] / (level[a] - level[b]);
    vx[++vertices] = vx[a] + t * (vx[b] - vx[a]); vy[vertices] = vy[a] + t * (vy[b] - vy[a]); vz[vertices] = vz[a] + t * (vz[b] - vz[a]);
    settle(vertices, 0, cell / 4);
    cuts[key] = vertices;
  }
  return cuts[key];
}
function face(a, b, c,    x, y, z, color) {
  x = (vx[a] + vx[b] + vx[c]) / 3; y = (vy[a] + vy[b] + vy[c]) / 3; z = (vz[a] + vz[b] + vz[c]) / 3;
  color = side[a] + side[b] + side[c] >= 0 ? "plumage" : z * z < 0.002 ? "beak" : "eye";
  faces[color] = faces[color] sprintf("f %d//%d %d//%d %d//%d\n", a, a, b, b, c, c);
}
# Divided along the shorter diagonal, which is where readers divide what starts with its end.
function quad(a, b, c, d,    e) {
  if ((vx[a] - vx[c]) ^ 2 + (vy[a] - vy[c]) ^ 2 + (vz[a] - vz[c]) ^ 2 > (vx[b] - vx[d]) ^ 2 + (vy[b] - vy[d]) ^ 2 + (vz[b] - vz[d]) ^ 2) {
    e = a; a = b; b = c; c = d; d = e;
  }
  if (side[a] + side[b] + side[c] + side[d] == 4)
    faces["plumage"] = faces["plumage"] sprintf("f %d//%d %d//%d %d//%d %d//%d\n", a, a, b, b, c, c, d, d);
  else { triangle(a, b, c); triangle(a, c, d); }
}
# The vertex of the cell with this lowest corner.
function of(i, j, k) { return cellVertex[i, j, k]; }

BEGIN {
  cell = 0.013;
  left = -0.28; low = -0.03; nx = 42; ny = 29; nz = 30; back = -nz / 2 * cell;
  for (i = 0; i <= nx; ++i)
    for (j = 0; j <= ny; ++j)
      for (k = 0; k <= nz; ++k) f[i, j, k] = duck(left + i * cell, low + j * cell, back + k * cell);

  # A vertex in each cell that the surface crosses: the mean of the crossings of its edges, moved onto the surface.
  for (i = 0; i < nx; ++i)
    for (j = 0; j < ny; ++j)
      for (k = 0; k < nz; ++k) {
        n = sx = sy = sz = 0;
        for (e = 0; e < 12; ++e) {
          axis = int(e / 4); p = e % 2; q = int(e / 2) % 2;
          ai = axis == 0 ? 0 : p; aj = axis == 1 ? 0 : axis == 0 ? p : q; ak = axis == 2 ? 0 : q;
          a = f[i + ai, j + aj, k + ak]; b = f[i + ai + (axis == 0), j + aj + (axis == 1), k + ak + (axis == 2)];
          if ((a < 0) == (b < 0)) continue;
          t = a / (a - b); ++n;
          sx += ai + t * (axis == 0); sy += aj + t * (axis == 1); sz += ak + t * (axis == 2);
        }
        if (n == 0) continue;
        cellVertex[i, j, k] = ++vertices;
        vx[vertices] = left + (i + sx / n) * cell; vy[vertices] = low + (j + sy / n) * cell; vz[vertices] = back + (k + sz / n) * cell;
        for (s = 0; s < 3; ++s) settle(vertices, 0, cell / 4);
      }

  # Vertices near the border of colors move onto it.
  for (v = 1; v <= vertices; ++v) {
    x = vx[v]; y = vy[v]; z = vz[v];
    level[v] = border(x, y, z); side[v] = level[v] < 0 ? -1 : 1;
    if (level[v] ^ 2 > 0.1 * cell ^ 2 * slopeOf(1, x, y, z)) continue;
    for (s = 0; s < 4; ++s) { settle(v, 1, cell / 4); settle(v, 0, cell / 4); }
    if ((vx[v] - x) ^ 2 + (vy[v] - y) ^ 2 + (vz[v] - z) ^ 2 < (0.4 * cell) ^ 2) side[v] = 0;
    else { vx[v] = x; vy[v] = y; vz[v] = z; }
  }

  # A quad around each edge of the grid that the surface crosses, seen from outside counterclockwise.
  for (i = 1; i < nx; ++i)
    for (j = 1; j < ny; ++j)
      for (k = 1; k < nz; ++k) {
        inside = f[i, j, k] < 0;
        if ((f[i + 1, j, k] < 0) != inside) {
          if (inside) quad(of(i, j - 1, k - 1), of(i, j, k - 1), of(i, j, k), of(i, j - 1, k));
          else quad(of(i, j - 1, k - 1), of(i, j - 1, k), of(i, j, k), of(i, j, k - 1));
        }
        if ((f[i, j + 1, k] < 0) != inside) {
          if (inside) quad(of(i - 1, j, k - 1), of(i - 1, j, k), of(i, j, k), of(i, j, k - 1));
          else quad(of(i - 1, j, k - 1), of(i, j, k - 1), of(i, j, k), of(i - 1, j, k));
        }
        if ((f[i, j, k + 1] < 0) != inside) {
          if (inside) quad(of(i - 1, j - 1, k), of(i, j - 1, k), of(i, j, k), of(i - 1, j, k));
          else quad(of(i - 1, j - 1, k), of(i - 1, j, k), of(i, j, k), of(i, j - 1, k));
        }
      }

  print "# Made by duck.awk";
  print "mtllib duck.mtl";
  for (v = 1; v <= vertices; ++v) printf "v %.4f %.4f %.4f\n", vx[v], vy[v], vz[v];
  for (v = 1; v <= vertices; ++v) {
    size = sqrt(slopeOf(0, vx[v], vy[v], vz[v]));
    printf "vn %.3f %.3f %.3f\n", gx / size, gy / size, gz / size;
  }
  printf "usemtl plumage\n%susemtl beak\n%susemtl eye\n%s", faces["plumage"], faces["beak"], faces["eye"];
}
