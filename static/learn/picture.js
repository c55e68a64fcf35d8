// @ts-check

/** Where a picture beside a lesson is. @param {string} id of the lesson @param {string} name of its file */
export function addressOfPicture(id, name) {
  return `/api/lessons/picture?${new URLSearchParams({ id, name })}`;
}
