/** What a value is, for a message that says what was found instead. */
export function kindOf(given: unknown): string {
  if (given === undefined || given === null) return String(given)
  return Array.isArray(given) ? 'array' : typeof given
}
