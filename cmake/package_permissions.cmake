# Runs before cpack packs: folders that it makes itself have the permissions that the builder's umask leaves
# (CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS does not reach all of them), and a package must not depend on that.
file(CHMOD_RECURSE ${CPACK_TEMPORARY_DIRECTORY} DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
