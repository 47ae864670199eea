// Marks (force, contact, outline) and hull facets: their own colour, lit just enough to show form.
in vec3 v_position;
in vec3 v_normal;

uniform vec4 u_color;      // display colour and opacity
uniform float u_form;      // 0: flat colour; 1: fully lit
uniform float u_edge;      // opacity that is added where the surface turns away

out vec4 o_color;

void main() {
  vec3 n = normalize(v_normal);
  if (!gl_FrontFacing) n = -n;
  float facing = clamp(dot(n, to_viewer(v_position)), 0.0, 1.0);
  float key = 0.42 + 0.58 * clamp(dot(n, u_key_dir) * 0.6 + 0.4, 0.0, 1.0);
  vec3 color = to_linear(u_color.rgb) * mix(1.0, key, u_form);
  o_color = vec4(sqrt(color), clamp(u_color.a + u_edge * (1.0 - facing), 0.0, 1.0));
}
