// Brushed steel: a studio of soft boxes mirrored in the surface; no textures.
in vec3 v_position;
in vec3 v_normal;

uniform vec4 u_color;  // display tint and opacity

out vec4 o_color;

void main() {
  vec3 n = normalize(v_normal);
  vec3 v = to_viewer(v_position);
  if (!gl_FrontFacing) n = -n;
  vec3 r = reflect(-v, n);
  float room = mix(0.06, 0.34, smoothstep(-0.6, 0.9, r.y));
  float box = smoothstep(0.45, 0.95, dot(r, u_key_dir));
  float strip = smoothstep(0.12, 0.02, abs(r.x - 0.62)) * smoothstep(-0.4, 0.3, r.y);
  float edge = 1.0 - clamp(dot(n, v), 0.0, 1.0);
  float light = room + u_key_strength * (0.85 * box + 0.12 * max(dot(n, u_key_dir), 0.0)) +
                0.35 * strip + 0.30 * edge * edge * edge;
  o_color = vec4(display(to_linear(u_color.rgb) * light), u_color.a);
}
