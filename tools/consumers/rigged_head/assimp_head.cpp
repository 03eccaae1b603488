// assimp_head FILE: what the Open Asset Import Library finds in a head, as JSON.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstdio>

int main(int, char** arguments) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(arguments[1], aiProcess_ValidateDataStructure);
  if (scene == nullptr) {
    std::fprintf(stderr, "%s\n", importer.GetErrorString());
    return 1;
  }
  std::printf("{\"version\": \"%u.%u.%u\", \"meshes\": {", aiGetVersionMajor(), aiGetVersionMinor(),
              aiGetVersionPatch());
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    std::printf("%s\"%s\": {\"vertices\": %u, \"targets\": [", m ? ", " : "", mesh.mName.C_Str(), mesh.mNumVertices);
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
      const aiAnimMesh& target = *mesh.mAnimMeshes[t];
      float lowest = 0;
      for (unsigned v = 0; v < mesh.mNumVertices; ++v)
        lowest = std::min(lowest, target.mVertices[v].y - mesh.mVertices[v].y);
      std::printf("%s{\"name\": \"%s\", \"weight\": %g, \"lowest\": %.7g}", t ? ", " : "", target.mName.C_Str(),
                  target.mWeight, lowest);
    }
    std::printf("]}");
  }
  std::printf("}, \"animations\": %u, \"morphs\": [", scene->mNumAnimations);
  const aiAnimation& animation = *scene->mAnimations[0];
  for (unsigned c = 0; c < animation.mNumMorphMeshChannels; ++c) {
    const aiMeshMorphAnim& channel = *animation.mMorphMeshChannels[c];
    std::printf("%s{\"name\": \"%s\", \"keys\": [", c ? ", " : "", channel.mName.C_Str());
    for (unsigned k = 0; k < channel.mNumKeys; ++k) {
      std::printf("%s{\"time\": %.9g, \"weights\": [", k ? ", " : "",
                  channel.mKeys[k].mTime / animation.mTicksPerSecond);
      for (unsigned t = 0; t < channel.mKeys[k].mNumValuesAndWeights; ++t) {
        std::printf("%s%.9g", t ? ", " : "", channel.mKeys[k].mWeights[t]);
      }
      std::printf("]}");
    }
    std::printf("]}");
  }
  std::printf("], \"turns\": {");
  for (unsigned c = 0; c < animation.mNumChannels; ++c) {
    const aiNodeAnim& channel = *animation.mChannels[c];
    std::printf("%s\"%s\": [", c ? ", " : "", channel.mNodeName.C_Str());
    for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) {
      const aiQuaternion& q = channel.mRotationKeys[k].mValue;
      std::printf("%s[%.9g, %.9g, %.9g, %.9g]", k ? ", " : "", q.x, q.y, q.z, q.w);
    }
    std::printf("]");
  }
  std::printf("}}\n");
}
