// Where a scope's flat picture shows nothing: no light.
out vec4 o_light;

void main() { o_light = vec4(0.0, 0.0, 0.0, 1.0); }
