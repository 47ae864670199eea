// The round picture of a scope: takes the flat picture through its lens (barrel), out of focus
// where it lies near or far, in water that takes light and gives some of it back, behind fog on the
// glass, within the field stop, with the camera's own exposure. FOG, WATER and SOFT say whether
// there are any, and whether anything is out of focus.
in vec2 v_at;

uniform sampler2D u_flat;      // linear light and distance, as a pinhole sees it
uniform vec2 u_size_px;        // of this picture
uniform float u_radius_px;     // of the round picture
uniform sampler2D u_half;      // its light out of focus, as of a disc of 3 of its pixels
uniform sampler2D u_quarter;   // the same of 9 pixels
uniform sampler2D u_milky;     // the same of a third of its half width: as fog spreads it
uniform vec3 u_bow_near;       // tangent off the middle by the share of the radius, in the square
uniform vec3 u_bow_far;        // of that: terms 0 to 2 and 3 to 5
uniform float u_flat_half;     // tangent of the flat picture's half width
uniform vec2 u_to_mark;        // unit, in the picture towards the mark on the field stop
uniform float u_exposure;
uniform vec3 u_white;          // what the camera shows of a white surface
uniform float u_focus;         // sharp at this distance, metres
uniform float u_blur_px;       // radius of blur, pixels of the flat picture, a dioptre off focus
uniform float u_taken;         // light that the water takes, each metre
uniform float u_blood;         // share of that which blood takes
uniform sampler2D u_water;     // as scope_water.frag has it
uniform float u_fog;           // share of the glass that is fogged

out vec4 o_color;

// Smooth values 0..1, one change a unit.
float noise(vec3 p) {
  vec3 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec3 u = fract(i * vec3(0.1031, 0.1030, 0.0973));
  vec3 w = fract((i + 1.0) * vec3(0.1031, 0.1030, 0.0973));
  // Of hash(): the dot product over x and y by corner, over z, and what stands beside them.
  vec4 x = vec4(u.x, w.x, u.x, w.x), y = vec4(u.y, u.y, w.y, w.y);
  vec4 s = x + y, d = 2.0 * x * y + 33.33 * s;
  vec2 z = vec2(u.z, w.z), e = z * (z + 33.33);
  vec4 t = s + 2.0 * d;
  vec4 lo = fract((t + 2.0 * e.x) * (d + (z.x + e.x)));
  vec4 hi = fract((t + 2.0 * e.y) * (d + (z.y + e.y)));
  vec4 m = mix(lo, hi, f.z);
  vec2 n = mix(m.xy, m.zw, f.y);
  return mix(n.x, n.y, f.x);
}

// Light through cloudy water, from the tip to the tissue and back: it falls by an exponential, and
// what the water scatters comes back from near by as a veil. Blood takes green and blue before red.
vec3 through_water(vec3 light, float distance_m, vec2 plane) {
  const vec3 kBlood = vec3(0.55, 1.5, 1.6);
  vec2 water = texture(u_water, 0.5 + 0.5 * plane / u_flat_half).rg;
  float mixed = u_taken * water.r * distance_m, plumes = water.g;
  vec3 takes = mixed * mix(vec3(1.0), kBlood, u_blood) + plumes * kBlood;
  float red = (mixed * u_blood + plumes) / max(mixed + plumes, 1e-9);
  vec3 left = exp(-2.0 * takes);
  vec3 veil = mix(vec3(0.34, 0.33, 0.30), vec3(0.20, 0.012, 0.010), red) * (0.55 + 0.45 * water.r);
  return light * left + veil * (1.0 - left);
}

vec2 on_plane(vec2 from_center) {
  float s = dot(from_center, from_center);
  vec3 n = u_bow_near, f = u_bow_far;
  return from_center * (n.x + s * (n.y + s * (n.z + s * (f.x + s * (f.y + s * f.z)))));
}

// Light spreads as the square of a disc's radius.
vec4 flat_at(vec2 plane) {
  vec2 uv = 0.5 + 0.5 * plane / u_flat_half;
  vec4 sharp = texture(u_flat, uv);
#ifdef SOFT
  float dioptres = abs(1.0 / max(sharp.a, 1e-3) - 1.0 / u_focus);
  float blur = min(u_blur_px * max(dioptres - 60.0, 0.0), 9.0);
  float spread = blur < 0.6 ? 0.0 : blur * blur;
  vec3 light = mix(sharp.rgb, texture(u_half, uv).rgb, min(spread / 9.0, 1.0));
  light = mix(light, texture(u_quarter, uv).rgb, max(spread - 9.0, 0.0) / 72.0);
  return vec4(light, sharp.a);
#else
  return sharp;
#endif
}

// Fine drops on the glass spread the light of all that is around; they leave holes where they run
// together.
vec3 through_fog(vec3 light, vec2 plane, vec2 from_center) {
  float patchy = noise(vec3(from_center * 3.0, 4.0)) + 0.25 * noise(vec3(from_center * 23.0, 8.0));
  float share = smoothstep(1.0 - u_fog, 1.25 - 0.9 * u_fog, patchy + 0.35 * u_fog) * min(1.0, 2.0 * u_fog);
  vec3 spread = texture(u_milky, 0.5 + 0.5 * plane / u_flat_half).rgb;
  vec3 milky = 0.75 * min(spread, vec3(2.0)) + vec3(0.10, 0.10, 0.11) / u_exposure;
  return mix(light, milky, 0.93 * share);
}

// As a camera rolls off what is too bright: above the knee it nears white and keeps its shades.
vec3 shown(vec3 c) {
  const float kKnee = 0.6;
  c = 1.7 * c * (1.0 + c / 16.0) / (1.0 + c);
  vec3 over = max(c - kKnee, 0.0) / (1.0 - kKnee);
  return sqrt(clamp(min(c, kKnee) + (1.0 - kKnee) * (1.0 - exp(-over)), 0.0, 1.0));
}

void main() {
  vec2 at_px = v_at * u_size_px - 0.5 * u_size_px;
  vec2 from_center = at_px / u_radius_px;
  float r = length(from_center);
  float stop = 1.0 - smoothstep(1.0 - 1.2 / u_radius_px, 1.0 + 1.2 / u_radius_px, r);
  // The mark that shows which way the view is tipped: a notch of the stop.
  vec2 across = vec2(-u_to_mark.y, u_to_mark.x);
  float along = dot(from_center, u_to_mark), aside = abs(dot(from_center, across));
  stop *= smoothstep(0.0, 2.5 / u_radius_px, max(0.955 - along, aside - 0.45 * (along - 0.955)) + 0.001);
  if (stop <= 0.0) {
    o_color = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  vec2 plane = on_plane(from_center);
  vec4 seen = flat_at(plane);
  vec3 light = seen.rgb;
#ifdef FOG
  light = through_fog(light, plane, from_center);
#endif
  light *= u_exposure;
#ifdef WATER
  light = through_water(light, max(seen.a, 1e-3), plane);
#endif
  float vignette = 1.0 - 0.55 * r * r * r - 0.15 * r * r;
  o_color = vec4(shown(light * vignette * u_white) * stop, 1.0);
}
