#include "picture/stage/stage_texture.h"

#include "archive/meshes/texture_file.h"

#include <vtkImageData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

namespace espalier::picture {
namespace {

/// The tangents follow from how place and texture change from pixel to pixel (Schüler 2006).
constexpr const char* bent_normal = R"(
  vec3 alongX = dFdx(vertexVC.xyz), alongY = dFdy(vertexVC.xyz);
  vec2 uvX = dFdx(tcoordVCVSOutput), uvY = dFdy(tcoordVCVSOutput);
  vec3 acrossX = cross(normalVCVSOutput, alongX), acrossY = cross(alongY, normalVCVSOutput);
  vec3 tangent = acrossY * uvX.x + acrossX * uvY.x;
  vec3 bitangent = acrossY * uvX.y + acrossX * uvY.y;
  float longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
  if (longest > 0.0) {
    vec3 bent = texture(relief, tcoordVCVSOutput).xyz * 2.0 - 1.0;
    normalVCVSOutput = normalize((tangent * bent.x + bitangent * bent.y) * inversesqrt(longest) +
                                 normalVCVSOutput * bent.z);
  }
  //VTK::Light::Impl)";

vtkSmartPointer<vtkTexture> repeated(const vtkSmartPointer<vtkImageData>& image) {
    if (!image) return nullptr;
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    texture->InterpolateOn();
    texture->MipmapOn();
    texture->RepeatOn();
    return texture;
}

}  // namespace

vtkSmartPointer<vtkTexture> texture_of(const std::filesystem::path& run, const std::string& file) {
    return repeated(texture_image(run, file));
}

void add_relief(vtkActor& actor, const std::filesystem::path& run, const std::string& file) {
    const auto normals = repeated(relief_images(run, file).normals);
    if (!normals) return;
    actor.GetProperty()->SetTexture("relief", normals);
    actor.GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", /*replaceFirst=*/true, bent_normal,
                                                            /*replaceAll=*/false);
}

}  // namespace espalier::picture
