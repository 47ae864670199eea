// Shared by every shader; put before its text. View space: x right, y up, z towards the viewer,
// metres. Colours are worked out in linear light (gamma 2) and shown through display().

uniform vec3 u_key_dir;        // unit, towards the key light
uniform float u_key_strength;  // 1: the default brightness
uniform float u_occlusion;     // 0..1, how much of the baked occlusion shows
uniform int u_orthographic;

vec3 to_linear(vec3 c) { return c * c; }

// Rolls off what is brighter than the screen instead of clipping it.
vec3 display(vec3 c) {
  c = c * (1.0 + 0.12 * c) / (0.86 + 0.30 * c);
  return sqrt(clamp(c, 0.0, 1.0));
}

vec3 to_viewer(vec3 position) {
  return u_orthographic != 0 ? vec3(0.0, 0.0, 1.0) : -normalize(position);
}
