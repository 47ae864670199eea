// Surfaces: bones, hulls, tool and marks.
in vec3 a_position;
in vec3 a_normal;
in vec4 a_shade;

uniform mat4 u_view_from_model;
uniform mat4 u_clip_from_view;
uniform vec2 u_outline;  // half pixel sizes in clip units times the outline's width; 0: none

invariant gl_Position;  // depth is drawn by one program, light by another

out vec3 v_position;
out vec3 v_model;
out vec3 v_normal;
out vec4 v_shade;

void main() {
  vec4 position = u_view_from_model * vec4(a_position, 1.0);
  vec3 normal = mat3(u_view_from_model) * a_normal;
  v_position = position.xyz;
  v_model = a_position;
  v_normal = normal;
  v_shade = a_shade;
  gl_Position = u_clip_from_view * position;
  gl_Position.xy += u_outline * normalize(normal.xy + vec2(1e-6)) * gl_Position.w;
}
