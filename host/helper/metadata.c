#include "helper/metadata.h"

#include <string.h>

static const struct aiMetadataEntry *find_entry(const struct aiScene *file, const char *key)
{
    const struct aiMetadata *all = file->mMetaData;
    for (unsigned i = 0; all != NULL && i < all->mNumProperties; i++)
        if (strcmp(all->mKeys[i].data, key) == 0) return &all->mValues[i];
    return NULL;
}

const char *cs_metadata_text(const struct aiScene *file, const char *key)
{
    const struct aiMetadataEntry *entry = find_entry(file, key);
    if (entry == NULL || entry->mType != AI_AISTRING) return "";
    return ((const struct aiString *)entry->mData)->data;
}

double cs_metadata_number(const struct aiScene *file, const char *key, double missing)
{
    const struct aiMetadataEntry *entry = find_entry(file, key);
    if (entry != NULL && entry->mType == AI_INT32) return (double)*(const int32_t *)entry->mData;
    if (entry != NULL && entry->mType == AI_FLOAT) return (double)*(const float *)entry->mData;
    if (entry != NULL && entry->mType == AI_DOUBLE) return *(const double *)entry->mData;
    return missing;
}
