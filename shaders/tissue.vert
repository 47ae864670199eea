// Tissue as a scope sees it: keeps the place in the part's own frame, for its pattern.
in vec3 a_position;
in vec3 a_normal;
in vec4 a_shade;

uniform mat4 u_view_from_model;
uniform mat4 u_clip_from_view;

invariant gl_Position;  // depth is drawn by one program, light by another

out vec3 v_position;
out vec3 v_normal;
out vec3 v_place;         // metres, in the part's frame
out vec4 v_shade;

void main() {
  vec4 position = u_view_from_model * vec4(a_position, 1.0);
  v_position = position.xyz;
  v_normal = mat3(u_view_from_model) * a_normal;
  v_place = a_position;
  v_shade = a_shade;
  gl_Position = u_clip_from_view * position;
}
