// The round picture of a scope: takes the flat picture through its lens (barrel), out of focus
// where it lies near or far, within the field stop, with the camera's own exposure.
in vec2 v_at;

uniform sampler2D u_flat;      // linear light and distance, as a pinhole sees it
uniform vec2 u_size_px;        // of this picture
uniform float u_radius_px;     // of the round picture
uniform float u_barrel;        // see ScopeDef
uniform float u_half_field;    // radians
uniform float u_flat_half;     // tangent of the flat picture's half width
uniform float u_tipped_to;     // angle in the picture of the mark on the field stop
uniform float u_exposure;
uniform float u_focus;         // sharp at this distance, metres
uniform float u_blur_px;       // radius of blur, pixels of the flat picture, a dioptre off focus

out vec4 o_color;

vec4 flat_at(vec2 from_center) {
  float r = length(from_center);
  float off = atan(r * tan(u_barrel * u_half_field)) / u_barrel;
  vec2 on_plane = r > 0.0 ? from_center / r * tan(off) : vec2(0.0);
  vec2 uv = 0.5 + 0.5 * on_plane / u_flat_half;
  vec4 sharp = texture(u_flat, uv);
  float dioptres = abs(1.0 / max(sharp.a, 1e-3) - 1.0 / u_focus);
  float blur = min(u_blur_px * max(dioptres - 60.0, 0.0), 9.0);
  if (blur < 0.6) return sharp;
  vec2 texel = 1.0 / vec2(textureSize(u_flat, 0));
  vec4 sum = sharp;
  for (int k = 0; k < 12; ++k) {
    float a = 2.39996 * float(k), q = sqrt((float(k) + 0.7) / 12.0);
    sum += texture(u_flat, uv + blur * q * vec2(cos(a), sin(a)) * texel);
  }
  return sum / 13.0;
}

// As a camera rolls off what is too bright.
vec3 shown(vec3 c) {
  c = c * (1.0 + c / 16.0) / (1.0 + c);
  return sqrt(clamp(1.7 * c, 0.0, 1.0));
}

void main() {
  vec2 at_px = v_at * u_size_px - 0.5 * u_size_px;
  vec2 from_center = at_px / u_radius_px;
  float r = length(from_center);
  float stop = 1.0 - smoothstep(1.0 - 1.2 / u_radius_px, 1.0 + 1.2 / u_radius_px, r);
  // The mark that shows which way the view is tipped: a notch of the stop.
  vec2 to_mark = vec2(cos(u_tipped_to), sin(u_tipped_to));
  float along = dot(from_center, to_mark), aside = abs(dot(from_center, vec2(-to_mark.y, to_mark.x)));
  stop *= smoothstep(0.0, 2.5 / u_radius_px, max(0.955 - along, aside - 0.45 * (along - 0.955)) + 0.001);
  if (stop <= 0.0) {
    o_color = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  vec3 light = flat_at(from_center).rgb * u_exposure;
  float vignette = 1.0 - 0.55 * pow(r, 3.0) - 0.15 * r * r;
  o_color = vec4(shown(light * vignette) * stop, 1.0);
}
