// Wet tissue under an arthroscope: the light comes from the tip, beside the eye, and falls off with
// distance. Each kind has its own pattern, worked out from the place alone. Writes linear light and
// the distance from the eye.
in vec3 v_position;
in vec3 v_normal;
in vec3 v_place;
in vec4 v_shade;  // openness, cavity, mottle; of cartilage: a half of how thick it is, 1 at most

// KIND: 0 bone, 1 cartilage, 2 meniscus, 3 ligament, tendon, 4 synovium, 5 fat, 6 steel, 7 disc
uniform vec3 u_tint;      // what its own colour makes of the pattern's
uniform vec3 u_fibre;     // unit, along the fibres, in the part's frame; of a meniscus: its axis
uniform float u_fineness;  // of a ligament's fibres: 1 for thick ones
uniform vec3 u_center;    // of the part, in its frame
uniform vec3 u_to_end, u_to_side;  // of a disc: 1 at its rim, along its longest and its next axis
uniform float u_light;    // strength at 10 mm

out vec4 o_light;

// Whole numbers strewn over all that an integer holds: a processor works with integers twice as fast
// as with fractions.
const ivec3 kStrew = ivec3(501125321, 1136930381, 1720413743);
const float kOfAll = 2.3283064e-10;  // of what an integer holds, with its sign

ivec4 strewn(ivec4 h) { return (h ^ (h >> 15)) * 668265261; }

// Smooth values 0..1, one change a unit: those of the eight corners around are mixed.
float noise(vec3 p) {
  vec3 whole = floor(p), f = p - whole;
  f = f * f * (3.0 - 2.0 * f);
  ivec3 a = ivec3(whole) * kStrew, b = a + kStrew;
  ivec4 xy = ivec4(a.x, b.x, a.x, b.x) ^ ivec4(a.y, a.y, b.y, b.y);
  vec4 m = mix(vec4(strewn(xy ^ a.z)), vec4(strewn(xy ^ b.z)), f.z);
  vec2 n = mix(m.xy, m.zw, f.y);
  return 0.5 + kOfAll * mix(n.x, n.y, f.x);
}

// Where in a cell of the grid its point lies, 0..1; `h` tells the cell.
vec3 strewn_point(int h) {
  h ^= h >> 15;
  return 0.5 + kOfAll * vec3(h * ivec3(668265261, 374761393, 1274126177));
}

float layers(vec3 p) {
  return 0.5 * noise(p) + 0.3 * noise(2.13 * p + 7.1) + 0.2 * noise(4.31 * p + 3.7);
}

// Distances to the nearest and the next of points strewn one a unit.
vec2 cells(vec3 p) {
  vec3 whole = floor(p), f = p - whole;
  ivec3 middle = ivec3(whole) * kStrew;
  vec2 near = vec2(9.0);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        ivec3 h = middle + ivec3(x, y, z) * kStrew;
        vec3 at = vec3(x, y, z) + strewn_point(h.x ^ h.y ^ h.z) - f;
        float d = dot(at, at);
        near = d < near.x ? vec2(d, near.x) : vec2(near.x, min(near.y, d));
      }
  return sqrt(near);
}

// The distance to the nearest of them as far as it is less than a half; else half or more. Eight of
// the 27 cells around tell it.
float near_cell(vec3 p) {
  vec3 whole = floor(p), f = p - whole, lowest = step(0.5, f) - 1.0;
  ivec3 first = ivec3(whole + lowest) * kStrew;
  float near = 9.0;
  for (int x = 0; x <= 1; ++x)
    for (int y = 0; y <= 1; ++y)
      for (int z = 0; z <= 1; ++z) {
        ivec3 h = first + ivec3(x, y, z) * kStrew;
        vec3 at = lowest + vec3(x, y, z) + strewn_point(h.x ^ h.y ^ h.z) - f;
        near = min(near, dot(at, at));
      }
  return sqrt(near);
}

// How much of a line of half a width `half_m` is at p, 0..1: the line is where a value is none. Its
// distance is the value over the slope along the surface, so it is as wide where the value is slow;
// there, at saddles and tops, it breaks off.
float line_at(float value, vec3 p, float half_m) {
  float slope = max(abs(dFdx(value)) / max(length(dFdx(p)), 1e-9),
                    abs(dFdy(value)) / max(length(dFdy(p)), 1e-9));
  float off_m = abs(value) / max(slope, 1e-3);
  return 1.0 - smoothstep(0.4 * half_m, half_m, off_m);
}

// Vessels, 0..1: thick ones where a slow noise crosses its middle, drawn out `stretch` times along a
// direction so that they run with the tissue; a level set would close into rings, so a slower noise
// thins them out to their ends. Thin ones leave the thick ones and fade away from them.
float vessels(vec3 p, vec3 along, float stretch, float per_m, float half_m) {
  vec3 q = p * per_m;
  q -= (1.0 - 1.0 / stretch) * dot(q, along) * along;
  q += 0.8 * vec3(noise(0.9 * q), noise(0.9 * q + 11.0), noise(0.9 * q + 23.0));
  float trunk = noise(0.55 * q + 5.0) - 0.5;
  float twig = noise(1.9 * q + 31.0) - 0.5;
  float fed = smoothstep(0.30, 0.60, noise(0.45 * q + 51.0));
  float beside = fed * (1.0 - smoothstep(0.0, 0.22, abs(trunk)));
  return max(fed * line_at(trunk, p, half_m * (0.3 + 0.7 * fed)),
             0.7 * beside * line_at(twig, p, 0.45 * half_m * (0.3 + 0.7 * beside)));
}

// The way that vessels of tissue without fibres run on the whole, in the part's frame.
const vec3 kVesselWay = vec3(0.36, 0.48, 0.80);

struct Look {
  vec3 albedo;
  float bump;      // height, metres
  float wet;       // strength of the highlight
  float deep;      // how far light goes into it: softens the shade
};

// Streaks along the fibres: u runs along them, slow; the two others fast.
float fibres(vec3 p, vec3 along, float per_m) {
  float u = dot(p, along);
  vec3 across = p - u * along;
  vec3 q = across * per_m + along * u * per_m * 0.06;
  return 0.6 * noise(q) + 0.4 * noise(2.7 * q + 9.0);
}

// Inside a joint bone lies under a thin skin of synovium: pink in patches, paler over knobs, with
// the small holes by which vessels enter.
Look bone_look(vec3 p) {
  float m = layers(p * 350.0);
  float pink = smoothstep(0.35, 0.68, layers(p * 130.0 + 4.0));
  vec3 c = mix(vec3(0.77, 0.59, 0.48), vec3(0.89, 0.80, 0.69), m);
  c = mix(c, vec3(0.80, 0.52, 0.45), 0.55 * pink);
  float ragged = near_cell(p * 560.0) + 0.09 * noise(p * 4200.0);
  float hole = (1.0 - smoothstep(0.06, 0.13, ragged)) * smoothstep(0.45, 0.65, noise(p * 140.0 + 61.0));
  c = mix(c, vec3(0.50, 0.26, 0.20), 0.55 * hole);
  float grain = layers(p * 1100.0);
  return Look(c, 2.2e-4 * m + 4e-5 * grain - 1.2e-4 * hole, 0.30, 0.20);
}

// Cartilage is glass-like: bluish white where it is thin over the bone, creamy where it is thick,
// with faint clouds and a surface that is never quite even. At its rim it thins out, and the synovium
// that creeps over bone shows in fringes: `thick` is 0 at the rim, 1 where it is full.
Look cartilage_look(vec3 p, float thick) {
  float m = layers(p * 120.0);
  float cloud = layers(p * 420.0 + 13.0);
  float fine = layers(p * 1400.0);
  vec3 c = mix(vec3(0.83, 0.85, 0.85), vec3(0.97, 0.93, 0.84), smoothstep(0.25, 0.75, m));
  c *= 0.95 + 0.09 * cloud;
  float full = smoothstep(0.0, 0.85, thick + 0.5 * (cloud - 0.5) + 0.25 * (fine - 0.5));
  c = mix(vec3(0.83, 0.65, 0.55), c, full);
  return Look(c, 2.0e-5 * fine + 1.1e-4 * cloud + 2.2e-4 * m, 0.30 + 0.30 * full, 0.30);
}

Look meniscus_look(vec3 p) {
  vec3 from_axis = p - u_center - dot(p - u_center, u_fibre) * u_fibre;
  vec3 round = normalize(cross(u_fibre, from_axis) + vec3(1e-6));
  // Rings about the axis: polar coordinates make the streaks follow the rim. The angle is the same
  // on both sides of a plane through the axis: where it leapt by a turn there would be a seam.
  float r = length(from_axis), h = dot(p - u_center, u_fibre);
  float a = abs(atan(dot(round, u_fibre.yzx), dot(round, u_fibre.zxy)));
  float f = noise(vec3(r * 2600.0, h * 2600.0, a * 3.0));
  float bundle = noise(vec3(r * 800.0, h * 800.0, a * 2.0 + 5.0));
  float m = layers(p * 260.0);
  vec3 c = mix(vec3(0.76, 0.66, 0.50), vec3(0.92, 0.88, 0.77), 0.45 * m + 0.3 * f + 0.25 * bundle);
  return Look(c, 3.5e-5 * f + 9e-5 * bundle + 4e-5 * m, 0.40, 0.35);
}

// A disc between bones is smooth and pale in the middle, where no vessels go, with faint fibres from
// end to end. Thick bundles run around it as its rim, with vessels, and end under synovium.
Look disc_look(vec3 p) {
  vec3 d = p - u_center;
  float s = dot(d, u_to_end), t = dot(d, u_to_side), h = dot(d, u_fibre);
  float m = layers(p * 330.0), wave = noise(p * 190.0 + 3.0);
  float r = pow(s * s * s * s + t * t * t * t, 0.25) + 0.10 * (wave - 0.5);
  float rim = smoothstep(0.46, 0.66, r);
  // The angle is the same on both sides of the middle: where it leapt by a turn there would be a seam.
  float around = abs(atan(t, s + 1e-4)), up = h * 900.0;
  float bundle = noise(vec3(15.0 * r, up, 2.2 * around));
  float thread = layers(vec3(38.0 * r, 2.6 * up, 3.5 * around + 9.0));
  float faint = noise(vec3(31.0 * t + 9.0 * wave, up, 5.0 * s));
  vec3 pale = mix(vec3(0.77, 0.70, 0.56), vec3(0.89, 0.85, 0.74), 0.75 * m + 0.25 * faint);
  vec3 tough = mix(vec3(0.63, 0.47, 0.35), vec3(0.92, 0.83, 0.69), 0.5 * thread + 0.5 * bundle);
  vec3 c = mix(pale, tough, rim);
  vec3 way = normalize(cross(u_fibre, s * s * s * u_to_end + t * t * t * u_to_side) + vec3(1e-6));
  float fed = smoothstep(0.60, 0.80, r);
  c = mix(c, vec3(0.64, 0.20, 0.15), 0.6 * fed * vessels(p, way, 5.0, 560.0, 1.1e-4));
  c = mix(c, vec3(0.82, 0.47, 0.38), 0.6 * smoothstep(0.84, 0.98, r + 0.16 * (m - 0.5)));
  float strands = (1.8e-4 * bundle + 6e-5 * thread) * rim + 8e-6 * faint * (1.0 - rim);
  return Look(c, strands + 3.2e-4 * rim + 6e-5 * m, 0.40, 0.30);
}

Look ligament_look(vec3 p) {
  float f = fibres(p, u_fibre, 2200.0 * u_fineness);
  float bundle = fibres(p, u_fibre, 480.0 * u_fineness);
  vec3 c = mix(vec3(0.70, 0.55, 0.42), vec3(0.93, 0.86, 0.74), 0.55 * f + 0.45 * bundle);
  float v = vessels(p, u_fibre, 7.0, 620.0, 1.0e-4);
  c = mix(c, vec3(0.66, 0.22, 0.17), 0.4 * v);
  return Look(c, (6e-5 * f + 2.2e-4 * bundle) / u_fineness, 0.40, 0.25);
}

Look synovium_look(vec3 p) {
  float m = layers(p * 160.0);
  vec2 villi = cells(p * 620.0);
  float tuft = smoothstep(0.5, 0.75, noise(p * 120.0 + 3.0));
  vec3 c = mix(vec3(0.74, 0.38, 0.30), vec3(0.86, 0.60, 0.50), m);
  c = mix(c, vec3(0.90, 0.66, 0.54), 0.35 * tuft * (1.0 - villi.x));
  float v = vessels(p, kVesselWay, 2.2, 380.0, 2.2e-4);
  c = mix(c, vec3(0.50, 0.07, 0.07), 0.75 * v);
  return Look(c, 4e-4 * m + 3.5e-4 * tuft * (1.0 - villi.x), 0.35, 0.40);
}

Look fat_look(vec3 p) {
  vec2 lobule = cells(p * 330.0);
  float rim = lobule.y - lobule.x;
  vec3 c = mix(vec3(0.80, 0.50, 0.26), vec3(0.93, 0.77, 0.45), smoothstep(0.0, 0.35, rim));
  c *= 0.94 + 0.12 * layers(p * 200.0);
  float v = vessels(p, kVesselWay, 2.2, 420.0, 1.5e-4);
  c = mix(c, vec3(0.60, 0.12, 0.10), 0.6 * v);
  return Look(c, 5e-4 * (1.0 - lobule.x * lobule.x), 0.45, 0.45);
}

Look steel_look(vec3 p) {
  float m = noise(p * 3000.0);
  return Look(vec3(0.46, 0.48, 0.51), 2e-6 * m, 0.6, 0.0);
}

Look look_at(vec3 p) {
  if (KIND == 7) return disc_look(p);
  if (KIND == 6) return steel_look(p);
  if (KIND == 1) return cartilage_look(p, min(2.0 * v_shade.z, 1.0));
  if (KIND == 2) return meniscus_look(p);
  if (KIND == 3) return ligament_look(p);
  if (KIND == 4) return synovium_look(p);
  if (KIND == 5) return fat_look(p);
  return bone_look(p);
}

// The power of the highlight, as products: steel 70, cartilage 80, meniscus and disc 55, ligament 45,
// synovium 38, fat 40, bone 30.
float glossy(float x) {
  float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8, x32 = x16 * x16, x64 = x32 * x32;
  if (KIND == 6) return x64 * x4 * x2;
  if (KIND == 1) return x64 * x16;
  if (KIND == 2 || KIND == 7) return x32 * x16 * x4 * x2 * x;
  if (KIND == 3) return x32 * x8 * x4 * x;
  if (KIND == 4) return x32 * x4 * x2;
  if (KIND == 5) return x32 * x8;
  return x16 * x8 * x4 * x2;
}

// The normal of the surface with its bumps, from how the height changes over neighbouring pixels
// (Mikkelsen, Bump Mapping Unparametrized Surfaces on the GPU, 2010).
vec3 bumped(vec3 n, float height) {
  vec3 dx = dFdx(v_position), dy = dFdy(v_position);
  float hx = dFdx(height), hy = dFdy(height);
  vec3 rx = cross(dy, n), ry = cross(n, dx);
  float det = dot(dx, rx);
  vec3 slope = sign(det) * (hx * rx + hy * ry);
  float size = abs(det);
  // What is seen at a glance changes too fast from pixel to pixel to tell a slope.
  float most = 0.8 * size;
  float steep = length(slope);
  slope *= steep > most ? most / steep : 1.0;
  return normalize(size * n - slope);
}

void main() {
#ifdef CHANGED
  if (is_left_out(v_place)) discard;
#endif
  float distance_m = length(v_position);
  vec3 v = v_position * (-1.0 / distance_m);
  vec3 n = normalize(v_normal);
  if (dot(n, v) < 0.0) n = -n;
  Look look = look_at(v_place);
  vec3 smooth_n = n;
  n = bumped(n, look.bump);

  // The light's fibres end around the lens, half a millimetre aside of the eye.
  vec3 to_light = normalize(vec3(0.0, 0.0006, 0.0) - v_position);
  float fall = 1e-4 / (distance_m * distance_m + 4e-6) * u_light;
  // Light ends towards the field's rim.
  fall *= smoothstep(0.45, 0.90, v.z);

  float straight = dot(n, to_light);
  float soaked = (straight + look.deep) / (1.0 + look.deep);
  float lit = clamp(mix(max(straight, 0.0), max(soaked, 0.0), 0.8), 0.0, 1.0);
  float open = mix(0.35, 1.0, v_shade.x);
  float cavity = v_shade.y * 2.0 - 1.0;

  vec3 albedo = look.albedo;
  if (KIND != 4) albedo *= u_tint;
  albedo = albedo * albedo;
  albedo *= 1.0 + 0.3 * clamp(cavity, -1.0, 0.5);
  // Shallow angles let light travel farther inside: red comes back.
  float edge = 1.0 - clamp(dot(smooth_n, v), 0.0, 1.0);
  vec3 inside = look.deep * 0.10 * edge * vec3(1.0, 0.55, 0.42) * albedo;

  vec3 h = normalize(to_light + v);
  float shine = glossy(max(dot(n, h), 0.0));
  // The film over it is smoother, and four times as sharp.
  vec3 film_n = mix(smooth_n, n, 0.5);
  float along = max(dot(film_n, h), 0.0), along2 = along * along, long2 = dot(film_n, film_n);
  float film = glossy(along2 * along2 / (long2 * long2));
  float speckle = 0.55 + 0.9 * noise(v_place * 900.0);
  float flat_on = 1.0 - clamp(dot(h, v), 0.0, 1.0), flat_on2 = flat_on * flat_on;
  float fresnel = 0.04 + 0.96 * flat_on2 * flat_on2 * flat_on;
  float spark = look.wet * speckle * (0.16 * shine + 1.6 * film) * (0.6 + 6.0 * fresnel);

  // Light that other walls send back: dim, warm, everywhere.
  vec3 around = vec3(0.055, 0.036, 0.030) * u_light * open / (1.0 + 400.0 * distance_m * distance_m * 100.0);
  vec3 light = (albedo * lit * open + inside) * fall + albedo * around + spark * fall * vec3(1.0, 0.98, 0.95);
  // Water takes red last of all and scatters a little.
  float water = exp(-9.0 * distance_m);
  light = light * vec3(1.0, 0.97, 0.95) * water + vec3(0.010, 0.007, 0.006) * (1.0 - water) * u_light;
  o_light = vec4(light, distance_m);
}
